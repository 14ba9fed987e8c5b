"""Mappings from names to values, where the language has lists: what is told shows how they are written."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Code
from tests.resolve.launching import outcome

if TYPE_CHECKING:
    from pathlib import Path

LISTS = [
    ("param: {rate: 2.0}", "param: [{name: rate, value: 2.0}]"),
    ("param: {rate: 2.0, id: 'a'}", 'param: [{name: rate, value: 2.0}, {name: id, value: "a"}]'),
    (
        "param: {limits: {max: 3, names: [a, 'b, c']}}",
        'param: [{name: limits, param: [{name: max, value: 3}, {name: names, value: [a, "b, c"]}]}]',
    ),
    ("param: {words: it's so}", "param: [{name: words, value: it's so}]"),
    ("param: {words: 'it''s: so'}", 'param: [{name: words, value: "it\'s: so"}]'),
    ("remap: {scan: /scan}", "remap: [{from: scan, to: /scan}]"),
    ("env: {LEVEL: high}", "env: [{name: LEVEL, value: high}]"),
    ("remap: {a: {b: c}}", "remap: [{from: a, to: ...}]"),
]


@pytest.mark.parametrize(("written", "meant"), LISTS)
def test_a_mapping_in_the_place_of_a_list_is_shown_as_the_list(
    tmp_path: Path, written: str, meant: str
) -> None:
    text = f"launch:\n- node: {{exec: a, name: n, {written}}}"
    (problem,) = outcome(tmp_path, text).problems
    assert (problem.code, problem.message) == (Code.WRONG_TYPE, "expected a list, found a mapping")
    if "..." in meant:
        assert (problem.notes, problem.suggestion) == ((f"it is written {meant}",), None)
    else:
        key, _, instead = meant.partition(": ")
        assert (problem.notes, problem.suggestion) == ((), instead)
        span = problem.span
        assert span is not None
        line = text.splitlines()[span.line - 1]
        assert f"{key}: {line[span.column - 1 : span.end_column - 1]}" == written


@pytest.mark.parametrize(("written", "meant"), LISTS[:1] + LISTS[5:7])
def test_what_is_shown_is_taken(tmp_path: Path, written: str, meant: str) -> None:
    assert written != meant
    assert not len(outcome(tmp_path, f"launch:\n- node: {{exec: a, name: n, {meant}}}").problems)


@pytest.mark.parametrize(
    ("action", "notes", "suggestion"),
    [
        ("node: {exec: a, param: [{rate: 2.0}]}", (), "{name: rate, value: 2.0}"),
        ("node: {exec: a, remap: [{scan: /scan}]}", (), "{from: scan, to: /scan}"),
        ("let: {world: maze}", (), "{name: world, value: maze}"),
        ("let:\n    world:\n      maze", ("it is written {name: world, value: maze}",), None),
        ("executable: {cmd: a, ready: {parameter: {rate: 5}}}", (), "{name: rate, value: 5}"),
        ("unset_env: {x: y}", ("the key 'name' is missing",), None),
    ],
)
def test_a_name_in_the_place_of_a_key_is_told_once(
    tmp_path: Path, action: str, notes: tuple[str, ...], suggestion: str | None
) -> None:
    first, *others = outcome(tmp_path, f"launch:\n- {action}", environment={"PATH": "/bin"}).problems
    assert (first.code, first.notes, first.suggestion) == (Code.UNKNOWN_KEY, notes, suggestion)
    assert not others


@pytest.mark.parametrize(
    ("written", "instead"),
    [
        ("remap: [scan:=/scan]", "{from: scan, to: /scan}"),
        ("remap: ['/a -> /b']", "{from: /a, to: /b}"),
        ("remap: scan:=/scan", "[{from: scan, to: /scan}]"),
        ("param: [use_sim_time:=true]", "{name: use_sim_time, value: true}"),
        ("param: [$(dirname)/a.yaml]", "{from: $(dirname)/a.yaml}"),
        ("param: a.yaml", "[{from: a.yaml}]"),
        ("param: [rate]", None),
        ("env: [A=b c]", "{name: A, value: b c}"),
        ("env: ['A=b, c']", '{name: A, value: "b, c"}'),
        ("env: A", None),
        (f"remap: '{':' * 20_000} /a /b'", None),
    ],
)
def test_a_text_in_the_place_of_a_pair_is_shown_as_one(
    tmp_path: Path, written: str, instead: str | None
) -> None:
    (problem,) = outcome(tmp_path, f"launch:\n- node: {{exec: a, name: n, {written}}}").problems
    assert (problem.code, problem.suggestion) == (Code.WRONG_TYPE, instead)


@pytest.mark.parametrize(
    ("action", "instead"),
    [
        ("let: a:=b", "{name: a, value: b}"),
        ("set_env: A=b", "{name: A, value: b}"),
        ("set_remap: a:=b", "{from: a, to: b}"),
        ("set_parameter: a:=b", "{name: a, value: b}"),
        ("arg: a:=b", "{name: a, default: b}"),
        ("arg: world", "{name: world}"),
        ("node: demo talker", "{pkg: demo, exec: talker}"),
        ("node: talker", None),
        ("executable: 'echo a, b'", '{cmd: "echo a, b"}'),
        ("timer: 5.0", None),
    ],
)
def test_a_text_in_the_place_of_an_action_is_shown_as_one(
    tmp_path: Path, action: str, instead: str | None
) -> None:
    (problem,) = outcome(tmp_path, f"launch:\n- {action}", environment={"PATH": "/bin"}).problems
    assert (problem.code, problem.suggestion) == (Code.WRONG_TYPE, instead)


def test_a_slip_is_told_as_one(tmp_path: Path) -> None:
    problems = outcome(tmp_path, "launch:\n- let: {nmae: x}").problems.ordered
    assert [(found.code, found.suggestion, found.notes) for found in problems] == [
        (Code.MISSING_KEY, None, ()),
        (Code.UNKNOWN_KEY, "name", ()),
    ]
