"""What it takes to resolve and to plan a node. Calls are counted, since times vary; loading is not among them."""

from __future__ import annotations

import cProfile
import os
import pstats
from typing import TYPE_CHECKING, Any

import pytest

from orchestra import pipeline
from orchestra.errors import Problems
from orchestra.load.files import load
from orchestra.plan import codec
from orchestra.plan.model import Component, Provenance
from orchestra.plan.render.formats import FORMATS
from tests.plan.records import at, node, plan

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from orchestra.plan.model import Plan

_NODE = """
- node:
    exec: /bin/true
    name: node_{0}
    namespace: $(var ns)
    param:
    - {{name: rate, value: {0}.5}}
    - {{name: frame, value: $(var ns)/base_{0}}}
    remap:
    - {{from: scan, to: scan_{0}}}
    - {{from: odom, to: /$(var ns)/odom}}
"""
_GIVEN_A_FILE = (
    "- node: {{exec: /bin/true, name: n{0},{1} param: [{{name: x, value: 1}}, {{from: p.yaml}}]}}\n"
)
_SECTIONS = {
    "of nodes": "/n{0}: {{ros__parameters: {{a: {0}, b: text}}}}\n",
    "with wildcards": "/**/n{0}: {{ros__parameters: {{a: {0}, b: text}}}}\n",
}


def _counted(function: Callable[..., Any], *arguments: object, **options: object) -> tuple[int, Any]:
    profile = cProfile.Profile()
    result = profile.runcall(function, *arguments, **options)
    calls: int = pstats.Stats(profile).total_calls  # type: ignore[attr-defined] # typeshed does not know it
    return calls, result


def _planned(folder: Path, text: str) -> tuple[int, Plan]:
    """Return how many calls it takes to make the plan of a loaded file, and the plan."""
    main = str(folder / "main.launch.yaml")
    (folder / "main.launch.yaml").write_text(text)
    inputs = pipeline.inputs_from([], environment=dict(os.environ))
    problems = Problems()
    description = load(main, problems, ())
    calls, plan = _counted(pipeline.collect, main, inputs, problems, load=lambda *_: description)
    assert not len(problems)
    return calls, plan


def _nodes(folder: Path, number: int) -> tuple[int, Plan]:
    return _planned(
        folder, "launch:\n- arg: {name: ns, default: robot}" + "".join(map(_NODE.format, range(number)))
    )


def test_a_node_takes_so_many_calls(tmp_path: Path) -> None:
    _nodes(tmp_path, 2)
    less, _ = _nodes(tmp_path, 10)
    more, plan = _nodes(tmp_path, 110)
    assert (more - less) / 100 < 540
    written, text = _counted(codec.dumps, plan, indent=2)
    assert written / 110 < 700
    read, again = _counted(codec.loads, text)
    assert read / 110 < 700
    assert again == plan


def test_a_node_is_shown_in_so_many_calls(tmp_path: Path) -> None:
    counts = [_counted(FORMATS["text"], _nodes(tmp_path, number)[1])[0] for number in (2, 10, 110)]
    assert (counts[2] - counts[1]) / 100 < 75


def test_components_are_gone_through_once_for_all_containers() -> None:
    counts: list[int] = []
    for number in (2, 50, 100):
        boxes = [node(f"/box{item}", "true", kind="container") for item in range(number)]
        held = tuple(_held(f"/c{item}", box.id) for item, box in enumerate(boxes))
        counts.append(_counted(FORMATS["text"], plan(*boxes, components=held))[0])
    assert counts[2] < 2.15 * counts[1]


def _held(identity: str, container: str) -> Component:
    return Component(
        identity,
        identity[1:],
        "/",
        "demo",
        "demo::Part",
        container,
        container,
        "started",
        {},
        (),
        {},
        None,
        at(9),
        Provenance(),
    )


@pytest.mark.parametrize(
    ("namespace", "sections"),
    [("", "of nodes"), (" namespace: /,", "of nodes"), (" namespace: /,", "with wildcards")],
)
def test_a_file_with_a_section_for_each_node_is_gone_through_once(
    tmp_path: Path, namespace: str, sections: str
) -> None:
    counts, sizes = [], []
    for number in (5, 60, 120):
        (tmp_path / "p.yaml").write_text("".join(map(_SECTIONS[sections].format, range(number))))
        nodes = (_GIVEN_A_FILE.format(item, namespace) for item in range(number))
        calls, plan = _planned(tmp_path, "launch:\n" + "".join(nodes))
        assert [process.parameters["a"] for process in plan.processes] == list(range(number))
        counts.append(calls)
        sizes.append(sum(len(file.content) for process in plan.processes for file in process.parameter_files))
    assert counts[2] < 2.15 * counts[1]
    if sections == "of nodes":  # those with wildcards may be for any node in a process, and are passed on
        assert sizes[2] <= 2.15 * sizes[1]
