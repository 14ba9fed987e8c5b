"""Launch files are read with the place of every fault; nothing is executed, nothing is guessed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orchestra.description.actions.group import Group
from orchestra.description.actions.node import Node
from orchestra.errors import Code, Problems
from orchestra.load.files import load
from orchestra.load.reader import Reader
from orchestra.load.yaml_file import read
from orchestra.location import point

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.description.launch import Description


def _load(
    text: str | bytes, folder: Path, name: str = "a.launch.yaml"
) -> tuple[Description | None, Problems]:
    path = folder / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    problems = Problems()
    return load(str(path), problems), problems


def _faults(problems: Problems) -> list[tuple[Code, int, int, str | None]]:
    return [
        (problem.code, problem.span.line, problem.span.column, problem.suggestion)
        for problem in problems.ordered
        if problem.span is not None
    ]


FAULTS: dict[str, tuple[str | bytes, list[tuple[Code, int, int, str | None]]]] = {
    "a misspelt key": ("launch:\n- node: {pkg: a, exce: b}", [(Code.UNKNOWN_KEY, 2, 18, "exec")]),
    "a misspelt key in a nested part": (
        "launch:\n- node:\n    exec: b\n    param:\n    - {name: x, valeu: 1}",
        [(Code.UNKNOWN_KEY, 5, 17, "value")],
    ),
    "an unknown action": ("launch:\n- ndoe: {exec: b}", [(Code.UNKNOWN_ACTION, 2, 3, "node")]),
    "a missing key": ("launch:\n- let: {name: a}", [(Code.MISSING_KEY, 2, 3, None)]),
    "a duplicate key": (
        "launch:\n- node:\n    exec: a\n    exec: b",
        [(Code.DUPLICATE_KEY, 4, 5, None)],
    ),
    "a duplicate in the other spelling": (
        "launch:\n- executable: {cmd: a, launch-prefix: b, launch_prefix: c}",
        [(Code.DUPLICATE_KEY, 2, 42, None)],
    ),
    "a mapping for a text": ("launch:\n- let: {name: {a: 1}, value: b}", [(Code.WRONG_TYPE, 2, 15, None)]),
    "a text for a list": ("launch:\n- node: {exec: a, param: b}", [(Code.WRONG_TYPE, 2, 26, None)]),
    "a word for a number": (
        "launch:\n- timer: {period: soon, children: []}",
        [(Code.WRONG_TYPE, 2, 19, None)],
    ),
    "a word for a flag": ("launch:\n- log: {message: a, if: perhaps}", [(Code.WRONG_TYPE, 2, 25, None)]),
    "nothing for a text": ("launch:\n- let: {name: a, value: }", [(Code.WRONG_TYPE, 2, 18, None)]),
    "two conditions": (
        "launch:\n- log: {message: a, if: true, unless: true}",
        [(Code.CONFLICTING_KEYS, 2, 31, None)],
    ),
    "an unknown substitution": (
        'launch:\n- log: {message: "x $(vra a)"}',
        [(Code.UNKNOWN_SUBSTITUTION, 2, 23, "var")],
    ),
    "two actions in one item": (
        "launch:\n- log: {message: a}\n  let: {name: a, value: b}",
        [(Code.WRONG_TYPE, 3, 3, "- let")],
    ),
    "a tag": ("launch:\n- log: {message: !!python/name:os.system a}", [(Code.SYNTAX, 2, 18, None)]),
    "nothing for a list of actions": ("launch:", [(Code.WRONG_TYPE, 1, 1, None)]),
    "a group of nothing": ("launch:\n- group:", [(Code.WRONG_TYPE, 2, 3, None)]),
    "a timer of nothing": ("launch:\n- timer: {period: 1, children: }", [(Code.WRONG_TYPE, 2, 22, None)]),
    "keys beside the root": ("launch: []\nother: 1", [(Code.UNKNOWN_KEY, 2, 1, None)]),
    "no YAML": ("launch: [", [(Code.SYNTAX, 1, 9, None)]),
    "two documents": ("launch: []\n---\nlaunch: []", [(Code.SYNTAX, 2, 1, None)]),
    "a misspelt root": ("lunch: []", [(Code.UNKNOWN_KEY, 1, 1, "launch")]),
    "an empty file": ("", [(Code.SYNTAX, 1, 1, None)]),
    "a list": ("- log: {message: a}", [(Code.WRONG_TYPE, 1, 1, None)]),
    "bytes that are no text": (b"launch:\n- log: {message: \xff}", [(Code.SYNTAX, 2, 18, None)]),
    "columns are code points": ("launch:\n- log: {message: üü, iff: 1}", [(Code.UNKNOWN_KEY, 2, 22, "if")]),
}


@pytest.mark.conforms("2.1 root", "2.1 empty", "2.1 child", "D7", "D8")
@pytest.mark.parametrize("case", FAULTS)
def test_a_fault_is_reported_once_at_its_place(case: str, tmp_path: Path) -> None:
    text, faults = FAULTS[case]
    _, problems = _load(text, tmp_path)
    assert _faults(problems) == faults


@pytest.mark.conforms("2.1 parse order")
def test_all_faults_of_a_file_are_reported_in_one_pass(tmp_path: Path) -> None:
    text = "launch:\n- node: {exce: a}\n- lgo: {message: a}\n- let: {name: a, value: $(nix)}\n"
    _, problems = _load(text, tmp_path)
    assert [fault[1] for fault in _faults(problems)] == [2, 3, 4]


def test_an_unknown_key_leaves_the_rest_of_the_action(tmp_path: Path) -> None:
    description, _ = _load("launch:\n- node: {exec: a, colour: b, namespace: c}", tmp_path)
    assert description is not None
    node = description.actions[0]
    assert isinstance(node, Node)
    assert node.faulty
    assert node.namespace is not None
    assert node.namespace.constant == "c"
    assert description.lost == {"a", "b", "c"}


TOO_MUCH = {
    "brackets": "launch: " + "[" * 100_000 + "]" * 100_000,
    "brackets that are never closed": "launch: " + "[{a: " * 60_000,
    "lists in lists": "launch:\n" + "- " * 100_000 + "a",
    "questions": "? " * 100_000 + "a",
    "an alias in what it names": "launch: &a [*a]",
    "aliases of aliases": "launch:\n- &a0 [x]\n"
    + "".join(f"- &a{i + 1} [*a{i}, *a{i}]\n" for i in range(40)),
}


@pytest.mark.parametrize("case", TOO_MUCH)
def test_what_nobody_writes_is_told_once_and_ends_nothing(case: str, tmp_path: Path) -> None:
    description, problems = _load(TOO_MUCH[case], tmp_path)
    assert description is None
    assert [problem.code for problem in problems] == [Code.SYNTAX]


def test_a_mistyped_key_counts_as_what_was_meant(tmp_path: Path) -> None:
    text = "launch:\n- nod: {exce: a, nmae: $(vra b), params: [{name: p, valeu: 1}]}"
    description, problems = _load(text, tmp_path)
    assert [(fault[2], fault[3]) for fault in _faults(problems)] == [
        (3, "node"),
        (9, "exec"),
        (18, "name"),
        (26, "var"),
        (34, "param"),
        (53, "value"),
    ]
    assert description is not None
    assert isinstance(description.actions[0], Node)


@pytest.mark.conforms("D6", "D7")
@pytest.mark.parametrize(
    "text",
    [
        "launch: []",
        "launch:\n- shutdown:\n- shutdown: {}",
        "launch:\n- node: {exec: a, env: [], param: []}",
        "launch:\n- log: {message: a, if: false}\n- node: {exec: a, respawn: true, respawn_delay: 2}",
        "launch:\n- arg: {name: a, default: 5}\n- let: {name: b, value: true}",
        "launch:\n- push-ros-namespace: {namespace: a}",
        "launch: {deprecated: use the other, children: [{log: {message: a}}]}",
        "launch:\n- group: [{log: {message: a}}]\n- group: {scoped: false, children: []}",
        "\ufefflaunch: []",
        "launch:\n- node: &n {exec: a}\n- node: {<<: *n, name: b}\n- node: *n",
    ],
)
def test_what_is_plainly_meant_is_accepted(text: str, tmp_path: Path) -> None:
    description, problems = _load(text, tmp_path)
    assert list(problems) == []
    assert description is not None
    assert not description.lost


def test_children_of_a_group_stand_in_order(tmp_path: Path) -> None:
    description, _ = _load("launch:\n- group:\n  - log: {message: a}\n  - log: {message: b}", tmp_path)
    assert description is not None
    group = description.actions[0]
    assert isinstance(group, Group)
    assert [child.message.raw for child in group.children] == ["a", "b"]  # type: ignore[attr-defined]


def test_aliases_that_expand_without_bound_are_refused_in_bounded_time(tmp_path: Path) -> None:
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x, x]"]
    lines += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 10)}]" for n in range(1, 10)]
    _, problems = _load("\n".join(lines), tmp_path)
    assert Code.SYNTAX in {problem.code for problem in problems}


@pytest.mark.parametrize("text", ["launch: &a [*a]", "launch: " + "[" * 500 + "]" * 500])
def test_files_that_nest_too_deeply_are_refused(text: str, tmp_path: Path) -> None:
    _, problems = _load(text, tmp_path)
    assert {problem.code for problem in problems} >= {Code.SYNTAX}


_NAMES = {
    "<launch/>": ("a.launch.xml", "a.xml", "a.launch", "A.LAUNCH.XML"),
    "launch: []": ("a.launch.yaml", "a.launch.yml", "a.yaml", "a.yml", "a.launch", "a.launch.YAML"),
}


@pytest.mark.conforms("2.1 extensions", "2.1 empty", "2.1 file open order")
@pytest.mark.parametrize(("text", "name"), [(text, name) for text, names in _NAMES.items() for name in names])
def test_the_end_of_its_name_tells_the_format_of_a_file(text: str, name: str, tmp_path: Path) -> None:
    description, problems = _load(text, tmp_path, name)
    assert list(problems) == []
    assert description is not None
    assert description.actions == ()


@pytest.mark.conforms("2.1 root attribute")
@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("<launch deprecated='use b'><log message='a'/></launch>", "a.launch.xml"),
        ("launch: {deprecated: use b, children: [log: {message: a}]}", "a.launch.yaml"),
    ],
)
def test_a_file_may_say_that_it_is_not_to_be_used_any_more(text: str, name: str, tmp_path: Path) -> None:
    description, problems = _load(text, tmp_path, name)
    assert list(problems) == []
    assert description is not None
    assert description.deprecated is not None
    assert description.deprecated.constant == "use b"
    assert len(description.actions) == 1


@pytest.mark.parametrize("name", ["a.launch.toml", "a"])
def test_a_format_that_is_not_known_is_named(name: str, tmp_path: Path) -> None:
    description, problems = _load("launch: []", tmp_path, name)
    assert description is None
    assert [problem.code for problem in problems] == [Code.UNKNOWN_FORMAT]


def test_a_file_that_cannot_be_read_is_reported_where_it_was_included(tmp_path: Path) -> None:
    problems = Problems()
    include = point("outer.yaml", 3, 4)
    assert load(str(tmp_path / "none.yaml"), problems, (include,)) is None
    assert [(problem.code, problem.span) for problem in problems] == [(Code.UNREADABLE_FILE, include)]


@given(st.text(max_size=200) | st.text("launch:[]{}-$()&*!|>'\"\n #a", max_size=80))
def test_no_text_breaks_the_reader(text: str) -> None:
    """Whatever stands in a file, it gives a tree or located problems."""
    problems = Problems()
    tree = read(text, "f.yaml", Reader(problems))
    assert tree is not None or problems.errors
    assert all(problem.span is not None for problem in problems)
