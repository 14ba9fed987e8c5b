"""So many things of one kind, right or wrong, take a work in proportion. Calls are counted, since times vary."""

from __future__ import annotations

import cProfile
import json
import os
import pstats
from typing import TYPE_CHECKING

import pytest

from orchestra import pipeline
from orchestra.load.alike import yaml_items
from orchestra.load.alike.learned import Forms

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

_SCHEMA = {"type": "object", "properties": {"rate": {"type": "integer"}}, "additionalProperties": False}
_NODE = "- node: {exec: /bin/true, name: n, params_schema: schema.json, param: ["


def _given(count: int) -> str:
    pairs = ", ".join(f"{{name: a{number}, value: b}}" for number in range(count))
    return f"- include: {{file: inner.yaml, arg: [{pairs}]}}"


def _undeclared(count: int) -> str:
    return _NODE + ", ".join(f"{{name: p{number}, value: 1}}" for number in range(count)) + "]}"


def _overruled(count: int) -> str:
    return _NODE + ", ".join(f"{{name: rate, value: v{number}}}" for number in range(count)) + "]}"


def _silenced(count: int) -> str:
    return "\n".join(
        f"- executable: {{cmd: 'true', name: p{number}, strange: x}}  # orchestra: ignore[ORC004]"
        for number in range(count)
    )


def _of_no_package(count: int) -> str:
    return "\n".join(
        f"- node: {{pkg: brinugp, exec: simulation, name: n{number}}}" for number in range(count)
    )


def _in_halves(count: int) -> str:
    pairs = "".join(f"    - name: p{number}\n    - value: 1\n" for number in range(count))
    return f"- node:\n    exec: /bin/true\n    name: n\n    param:\n{pairs}"


def _contained(count: int) -> str:
    return "\n".join(
        f"- node_container: {{pkg: rclcpp_components, exec: component_container, name: c{number}, namespace: '',"
        f" composable_node: [{{pkg: demo_nodes, plugin: 'demo::Talker', name: n{number}}}]}}"
        for number in range(count)
    )


def _strange(count: int) -> str:
    return "- node:\n    exec: /bin/true\n" + "".join(f"    strange_{number}: 1\n" for number in range(count))


_KINDS: dict[str, Callable[[int], str]] = {
    "arguments of an include": _given,
    "parameters that nobody declares": _undeclared,
    "values of one parameter": _overruled,
    "problems that a comment silences": _silenced,
    "nodes of a package that is not here": _of_no_package,
    "items that are two": _in_halves,
    "containers of a package that is not here": _contained,
    "keys that are unknown": _strange,
}


def _calls(folder: Path, text: str) -> int:
    path = folder / "main.launch.yaml"
    path.write_text(f"launch:\n{text}\n")
    inputs = pipeline.inputs_from([], environment=dict(os.environ))
    profile = cProfile.Profile()
    profile.enable()
    pipeline.check(str(path), inputs)
    profile.disable()
    total: int = pstats.Stats(profile).total_calls  # type: ignore[attr-defined] # typeshed does not know it
    return total


@pytest.mark.parametrize("kind", _KINDS)
def test_twice_as_many_take_twice_the_work(
    tmp_path: Path, kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Forms of actions are learned before it counts, whatever other tests have had read.
    monkeypatch.setattr(yaml_items, "FORMS", Forms(few=4, short=0))
    (tmp_path / "schema.json").write_text(json.dumps(_SCHEMA))
    (tmp_path / "inner.yaml").write_text("launch:\n- log: {message: a}\n")
    made = _KINDS[kind]
    for count in (60, 240):  # long files import more
        _calls(tmp_path, made(count))
    once, twice, four_times = (_calls(tmp_path, made(count)) for count in (60, 120, 240))
    assert four_times - twice < 2.2 * (twice - once), f"{once} calls, then {twice} and {four_times}"
