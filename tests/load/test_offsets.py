"""Every character of a YAML scalar's value is found again in the file, whatever style it is written in."""

from __future__ import annotations

import re

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from orchestra.load.offsets import source, spans_of

PLAIN = st.text(
    st.characters(codec="utf-8", exclude_categories=("Cs", "Cc"), exclude_characters="\ufffe\uffff"),
    min_size=1,
    max_size=40,
)


def _node(text: str) -> yaml.ScalarNode:
    node = yaml.compose(text, Loader=yaml.CBaseLoader)
    assert isinstance(node, yaml.ScalarNode)
    return node


def _written(text: str, first: int, last: int) -> str:
    """Return what stands in the file where a part of the value is said to stand."""
    node = _node(text)
    whole = source("f.yaml", text)
    spans = spans_of(whole, node.start_mark.index, node.end_mark.index, node.value, node.style)
    span = spans(first, last)
    begin = whole.lines[span.line - 1] + span.column - 1
    end = whole.lines[span.end_line - 1] + span.end_column - 1
    return text[begin:end]


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("one two three", "two"),
        ("'it''s two'", "two"),
        ('"a\\tb two"', "two"),
        ('"\\u00fc two"', "two"),
        ('"one \\\n   two"', "two"),
        ("'one\n  two'", "two"),
        ("|\n  one\n  two\n", "two"),
        (">-\n  one\n  two\n", "two"),
        ("|\n    one\n      two three\n", "two three"),
        ("!!str two", "two"),
    ],
)
def test_a_part_of_a_scalar_is_where_it_is_said_to_be(text: str, part: str) -> None:
    at = _node(text).value.index(part)
    assert _written(text, at, at + len(part)) == part


def test_a_quote_that_is_written_twice_is_one_place() -> None:
    assert _written("'it''s'", 2, 3) == "'"


def test_an_escape_starts_at_its_backslash() -> None:
    assert _written('"a\\u0041b"', 2, 3) == "b"


@given(PLAIN)
def test_double_quoted_text_is_found_character_by_character(value: str) -> None:
    quoted = '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    node = _node(quoted)
    for at, character in enumerate(node.value):
        written = _written(quoted, at, at + 1)
        assert written == ("\\" if character in '"\\' else character)


@given(st.text("ab \n", min_size=1, max_size=30))
def test_block_text_is_found_character_by_character(value: str) -> None:
    text = "|2+\n" + "".join(f"  {line}\n" for line in value.split("\n"))
    node = _node(text)
    for at, character in enumerate(node.value):
        assert _written(text, at, at + 1) == character


@given(st.text("a\n\r\x85\u2028\u2029", max_size=40), st.integers(0, 40))
def test_places_count_lines_as_yaml_does(text: str, offset: int) -> None:
    whole = source("f", text)
    line, column = whole.place(min(offset, len(text)))
    assert whole.lines[line - 1] + column - 1 == min(offset, len(text))


@given(st.text(st.sampled_from("ab \n\r\x0b\x0c\x1c\x1e\x85\u2028\u2029ü"), max_size=30))
def test_lines_begin_behind_what_yaml_takes_for_breaks(text: str) -> None:
    ends = re.finditer("\r\n|[\n\r\x85\u2028\u2029]", text)
    assert source("f.yaml", text).lines == (0, *(end.end() for end in ends))
