"""Keys and names of actions as people spell them."""

from __future__ import annotations

import pytest

from orchestra.description.actions import ACTIONS
from orchestra.description.actions.node import Node
from orchestra.description.source import Keyed, Written
from orchestra.errors import Code, Problems
from orchestra.load.keys import known_keys, meant
from orchestra.load.reader import Reader
from orchestra.load.words import ELSEWHERE
from orchestra.location import Span

KNOWN = frozenset({"name", "value", "launch_prefix"})


def _nowhere(first: int, last: int) -> Span:
    return Span("a", 1, 1 + first, 1, 1 + last)


def _mapping(*keys: str) -> Keyed:
    mapping = Keyed(Span("a", 1, 1, 9, 1), Span("a", 1, 1, 1, 1))
    for line, key in enumerate(keys, 1):
        at = Span("a", line, 1, line, 1 + len(key))
        mapping.put(key, Written(f"of {key}", at, _nowhere), at)
    return mapping


def _read(*keys: str) -> tuple[Keyed, list[tuple[Code, int, str | None]]]:
    problems = Problems()
    read = known_keys(KNOWN, _mapping(*keys), Reader(problems).error)
    return read, [
        (problem.code, problem.span.line, problem.suggestion)
        for problem in problems
        if problem.span is not None
    ]


def test_known_keys_are_left_as_they_are() -> None:
    mapping = _mapping("name", "value")
    assert known_keys(KNOWN, mapping, Reader(Problems()).error) is mapping


def test_both_ways_to_join_words_are_one() -> None:
    read, problems = _read("launch-prefix")
    assert list(read) == ["launch_prefix"]
    assert problems == []
    assert not read.lossy


def test_a_key_in_both_ways_stands_twice() -> None:
    read, problems = _read("launch_prefix", "launch-prefix")
    assert read["launch_prefix"].text == "of launch_prefix"
    assert problems == [(Code.DUPLICATE_KEY, 2, None)]


def test_a_slip_is_read_as_what_was_meant_unless_that_stands_there() -> None:
    read, problems = _read("nmae", "valeu")
    assert {key: value.text for key, value in read.items()} == {"name": "of nmae", "value": "of valeu"}
    assert problems == [(Code.UNKNOWN_KEY, 1, "name"), (Code.UNKNOWN_KEY, 2, "value")]
    read, problems = _read("nmae", "name")
    assert read["name"].text == "of name"
    assert problems == [(Code.UNKNOWN_KEY, 1, None)]
    assert read.lossy


def test_two_slips_for_one_key_are_told_both() -> None:
    read, problems = _read("nmae", "naem")
    assert [value.text for value in read.values()] == ["of nmae"]
    assert [code for code, _, _ in problems] == [Code.UNKNOWN_KEY] * 2


def test_a_far_key_is_left_out() -> None:
    read, problems = _read("colour", "name")
    assert list(read) == ["name"]
    assert problems == [(Code.UNKNOWN_KEY, 1, None)]
    assert read.lossy


@pytest.mark.parametrize(
    ("word", "known", "expected"),
    [
        ("executable", Node.known_keys(), ("exec", False)),
        ("ros-arguments", Node.known_keys(), ("ros_args", False)),
        ("nod", ACTIONS, ("node", True)),
        ("push_ros_namespaces", ACTIONS, ("push_ros_namespace", True)),
        ("declare_argument", ACTIONS, ("arg", False)),
        ("rviz", ACTIONS, (None, False)),
    ],
)
def test_what_a_word_means(word: str, known: frozenset[str], expected: tuple[str | None, bool]) -> None:
    assert meant(word, known, {**ELSEWHERE, "executable": "exec", "ros_arguments": "ros_args"}) == expected


def test_words_of_other_dialects_mean_actions_that_are_here() -> None:
    assert set(ELSEWHERE.values()) <= set(ACTIONS)
    assert not set(ELSEWHERE) & set(ACTIONS)
