from __future__ import annotations

import json
import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from orchestra.description.written import escaped
from orchestra.errors import Code, Problems
from orchestra.load.grammar import parse_template
from orchestra.location import Span
from orchestra.resolve.context import Poison
from orchestra.resolve.words import split

if TYPE_CHECKING:
    from orchestra.resolve.context import Value
    from tests.resolve.texts.conftest import Place

_PROBES = [
    json.loads(line)
    for line in Path(__file__).parents[2].joinpath("data/launch-probes.jsonl").read_text("utf-8").splitlines()
]


@pytest.mark.parametrize(
    "probe", [probe for probe in _PROBES if probe["k"] == "argv"], ids=lambda probe: probe["in"]
)
def test_what_upstream_splits_is_split_alike(probe: dict[str, Any], place: Place) -> None:
    assert place.words(probe["in"]) == probe["out"]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", []),
        ("   ", []),
        ("''", [""]),
        ('"a $(var a) b"', ["a A b"]),
        ("--x='$(var a)'", ["--x=A"]),
        ("--x='$(var spaced)' y", ["--x=two words", "y"]),
        ("$(var spaced)", ["two words"]),
        ("$(var quotes) y", ["it's \"", "y"]),
        ("a $(var empty) b", ["a", "", "b"]),
        ("$(var empty)$(var empty)", [""]),
        ("x$(var empty)", ["x"]),
        (r"a\ b", ["a", "b"]),
        (r"a\\ b", ["a b"]),
        (r"\\\\", ["\\"]),
        ("a\tb\nc\r\nd", ["a", "b", "c", "d"]),
        ("# $(var a)", ["#", "A"]),
    ],
)
def test_quotes_join_and_substitutions_never_split(text: str, words: list[str], place: Place) -> None:
    place.set("spaced", "two words")
    place.set("quotes", "it's \"")
    place.set("empty", "")
    assert place.words(text) == words
    assert not len(place.problems)


@pytest.mark.parametrize(
    ("text", "at", "told"),
    [
        ("a 'b c", "'", "this ' is not closed"),
        ('a"$(var a) b', '"', 'this " is not closed'),
        ("it's", "'", "this ' is not closed"),
    ],
)
def test_an_open_quote_is_told_at_its_place(text: str, at: str, told: str, place: Place) -> None:
    assert place.words(text) is None
    (problem,) = place.problems
    assert (problem.code, place.stretch(problem.span), problem.message) == (
        Code.SUBSTITUTION_SYNTAX,
        at,
        told,
    )


@pytest.mark.parametrize("text", [r"a \\", r"a \\$(var a)"])
def test_a_backslash_before_nothing_is_told(text: str, place: Place) -> None:
    assert place.words(text) is None
    (problem,) = place.problems
    assert problem.message == "this backslash escapes nothing"


def test_each_word_points_at_where_it_is_written(place: Place) -> None:
    template = place.write("run --to='$(var a)' $(var a)x 'a b'")
    words = split(template, place.context)
    assert not isinstance(words, Poison)
    assert [place.stretch(word.location.span) for word in words] == [
        "run",
        "--to='$(var a)'",
        "$(var a)x",
        "'a b'",
    ]


def test_a_word_whose_text_is_written_otherwise_points_at_the_whole_piece(place: Place) -> None:
    words = split(place.write(r"a\$ b $(var a)"), place.context)
    assert not isinstance(words, Poison)
    assert [place.stretch(word.location.span) for word in words] == [r"a\$ b ", r"a\$ b ", "$(var a)"]


def test_a_text_over_several_lines_points_at_its_lines(place: Place) -> None:
    def spans(start: int, end: int) -> Span:
        lines = "a\nb".splitlines(keepends=True)
        return Span("f", 1 + (start >= len(lines[0])), 1, 1 + (end >= len(lines[0])), 2)

    words = split(parse_template("a\nb", spans, Problems()), place.context)
    assert not isinstance(words, Poison)
    assert [(word.text, word.location.span) for word in words] == [
        ("a", Span("f", 1, 1, 2, 2)),
        ("b", Span("f", 1, 1, 2, 2)),
    ]


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow], max_examples=50)
@given(st.lists(st.sampled_from(["a", "é.", " ", "\t", "\n", "$(var a)", "$(var two)", "$(var empty)"])))
def test_words_are_the_same_where_quotes_are_about(place: Place, pieces: list[str]) -> None:
    place.set("two", "two words")
    place.set("empty", "")
    text = "".join(pieces)
    plain, quoted = (split(place.write(item), place.context) for item in (text, f"{text} ''"))
    assert not isinstance(plain, Poison)
    assert not isinstance(quoted, Poison)
    assert [_told(word) for word in plain] == [_told(word) for word in quoted[:-1]]


def _told(word: Value) -> tuple[object, ...]:
    return word.text, word.location, word.raw, word.verbatim, [read.name for read in word.through]


def test_faults_inside_substitutions_make_the_whole_poison(place: Place) -> None:
    assert place.words("a $(var missing) $(env NOPE) 'b") is None
    assert [problem.code for problem in place.problems] == [Code.UNDEFINED_VARIABLE, Code.UNSET_ENVIRONMENT]
    assert place.words("a $(var poisoned)") is None
    assert place.words("$(nosuch") is None


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
@given(st.text(alphabet="ab '\"\\\t\n$é"))
def test_a_text_without_substitutions_is_split_as_by_a_shell(place: Place, text: str) -> None:
    try:
        expected = shlex.split(text)
    except ValueError:
        assert place.words(escaped(text)) is None
    else:
        assert place.words(escaped(text)) == expected


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
@given(st.lists(st.text(alphabet="ab '\"\\\t\n$()é")))
def test_substituted_words_come_through_unchanged(place: Place, words: list[str]) -> None:
    for index, word in enumerate(words):
        place.set(f"v{index}", word)
    bare = " ".join(f"$(var v{index})" for index in range(len(words)))
    quoted = " ".join(f"'$(var v{index})'" for index in range(len(words)))
    assert place.words(bare) == place.words(quoted) == words
