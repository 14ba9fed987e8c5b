"""What holds for every launch file, whatever is in it."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from orchestra.errors import Problem, Problems
from orchestra.location import Location, Span
from orchestra.pipeline import collect, inputs_from
from orchestra.plan.codec import dumps, loads
from tests.plan.strategies import NAMES, Actions, actions, descriptions, inner_actions

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.plan.model import Plan

_ROOT = Path(__file__).parents[2]
_ENVIRONMENT = {"PATH": "/bin", "A_1": "outside"}
_quickly = settings(
    max_examples=80,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)


def _planned(folder: Path, written: Actions, inner: Actions, *, block: bool = False) -> tuple[Plan, Problems]:
    for name, content in (("main.launch.yaml", written), ("inner.launch.yaml", inner)):
        text = (
            yaml.safe_dump({"launch": content}, allow_unicode=True)
            if block
            else json.dumps({"launch": content})
        )
        (folder / name).write_text(text, "utf-8")
    problems = Problems()
    plan = collect(str(folder / "main.launch.yaml"), inputs_from([], environment=_ENVIRONMENT), problems)
    assert plan is not None
    return plan, problems


@given(descriptions, inner_actions, st.booleans())
@_quickly
def test_a_plan_survives_json_and_is_the_same_every_time(
    tmp_path: Path, written: Actions, inner: Actions, block: bool
) -> None:
    plan, problems = _planned(tmp_path, written, inner, block=block)
    again, _ = _planned(tmp_path, written, inner, block=block)
    assert dumps(loads(dumps(plan))) == dumps(plan)
    assert dumps(again) == dumps(plan)
    assert plan.problems == problems.ordered
    ids = [process.id for process in plan.processes] + [component.id for component in plan.components]
    assert len(set(ids)) == len(ids)


@given(descriptions, inner_actions, st.booleans())
@_quickly
def test_every_place_is_one_in_its_file(
    tmp_path: Path, written: Actions, inner: Actions, block: bool
) -> None:
    plan, _ = _planned(tmp_path, written, inner, block=block)
    lines = {str(path): path.read_text("utf-8").split("\n") for path in tmp_path.iterdir()}
    for span in _spans(plan):
        text = lines[span.file]
        assert 1 <= span.line <= span.end_line <= len(text)
        assert 1 <= span.column <= len(text[span.line - 1]) + 1
        assert 1 <= span.end_column <= len(text[span.end_line - 1]) + 1
        assert (span.line, span.column) <= (span.end_line, span.end_column)


def _spans(value: Any) -> Iterator[Span]:
    if isinstance(value, Span):
        yield value
    elif isinstance(value, Location | Problem) or dataclasses.is_dataclass(value):
        for entry in dataclasses.fields(value):
            yield from _spans(getattr(value, entry.name))
    elif isinstance(value, dict):
        for item in value.values():
            yield from _spans(item)
    elif isinstance(value, tuple):
        for item in value:
            yield from _spans(item)


def _probe() -> Actions:
    """Return actions that tell all that is set where they stand."""
    said = " ".join(f"$(var {name} none) $(env {name.upper()}_1 none) $(param {name} none)" for name in NAMES)
    node = {"exec": "probe", "name": "probe", "namespace": "here"}
    return [{"log": {"message": said}}, {"node": node}]


@pytest.mark.conforms("4.2 scoped and forwarding", "4.2 scoped data", "D25")
@given(
    descriptions,
    st.lists(actions, max_size=5),
    inner_actions,
    st.sampled_from(["group", "closed", "timer", "each"]),
)
@_quickly
def test_nothing_that_a_scope_sets_is_seen_outside(
    tmp_path: Path, before: Actions, inside: Actions, inner: Actions, kind: str
) -> None:
    scopes: dict[str, dict[str, Any]] = {
        "group": {"group": {"children": inside}},
        "closed": {"group": {"forwarding": False, "children": inside}},
        "timer": {"timer": {"period": 1, "children": inside}},
        "each": {"group": {"scoped": False, "for_each": {"a": [1, 2]}, "children": inside}},
    }
    without, _ = _planned(tmp_path, [*before, *_probe()], inner)
    with_scope, _ = _planned(tmp_path, [*before, scopes[kind], *_probe()], inner)
    assert _told(with_scope) == _told(without)


def _told(plan: Plan) -> tuple[object, ...]:
    message = [trigger.do[-1] for trigger in plan.triggers if trigger.delay is None][-1]
    node = plan.processes[-1]
    return (
        *(getattr(message, "message", None), node.name, node.namespace, node.environment, node.parameters),
        *(node.remappings, node.command[:5]),
    )


def _seeds() -> dict[str, str]:
    files = [*(_ROOT / "bringup").glob("*.yaml"), *(_ROOT / "tests" / "data" / "ordinary").rglob("*.yaml")]
    return {str(path.relative_to(_ROOT)): path.read_text("utf-8") for path in sorted(files)}


_SEEDS = _seeds()
_PIECES = (
    *(
        "$(var x)",
        "$(",
        "$(eval 1/0)",
        "$(command 'false')",
        "$(dirname)",
        "$(find-pkg-share nope)",
        "~",
        "null",
    ),
    *(
        "[]",
        "{}",
        '"',
        "'",
        "- ",
        "  ",
        "\t",
        "\n",
        ": ",
        "&a ",
        "*a",
        "<<: *a",
        "!!int ",
        "!foo ",
        "|",
        ">",
        "-1",
    ),
    *(
        "1e400",
        ".nan",
        "99999999999999999999",
        "é",
        "\U0001f600",
        "\x01",
        "unless",
        "for_each: {x: [1, 2]}",
        "/**",
    ),
)
_edits = st.lists(
    st.tuples(st.floats(0, 1, exclude_max=True), st.integers(0, 10), st.sampled_from(("", *_PIECES))),
    min_size=1,
    max_size=4,
)


@given(name=st.sampled_from(sorted(_SEEDS)), edits=_edits)
@settings(_quickly, max_examples=300)
def test_no_text_whatsoever_is_a_bug_and_every_problem_has_its_place(
    tmp_path: Path, name: str, edits: list[tuple[float, int, str]]
) -> None:
    _read_edited(tmp_path, name, edits)


@pytest.mark.long
@pytest.mark.timeout(900)
@given(name=st.sampled_from(sorted(_SEEDS)), edits=_edits)
@settings(_quickly, max_examples=20_000)
def test_no_text_whatsoever_is_a_bug_however_many_are_tried(
    tmp_path: Path, name: str, edits: list[tuple[float, int, str]]
) -> None:
    _read_edited(tmp_path, name, edits)


def _read_edited(folder: Path, name: str, edits: list[tuple[float, int, str]]) -> None:
    text = _SEEDS[name]
    for where, removed, piece in edits:
        at = int(where * (len(text) + 1))
        text = text[:at] + piece + text[at + removed :]
    path = folder / "any.launch.yaml"
    path.write_bytes(text.encode())
    problems = Problems()
    plan = collect(str(path), inputs_from([], environment=_ENVIRONMENT), problems)
    assert plan is not None or problems.errors
    for problem in problems:
        assert problem.span is not None
        assert problem.message
        assert "\n" not in problem.message
    if plan is not None:
        assert json.loads(dumps(plan))["version"] == 1
