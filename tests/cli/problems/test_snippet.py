"""The marks stand under what they mean, whatever the line is made of."""

from __future__ import annotations

import unicodedata

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orchestra.cli.problems.snippet import snippet


@pytest.mark.parametrize(
    ("line", "column", "end_column", "source", "marks"),
    [
        ("  nam: talker", 3, 6, "  nam: talker", "  ^^^"),
        ("  nam: talker", 3, 3, "  nam: talker", "  ^"),  # an empty span is one mark
        ("name: x", 7, None, "name: x", "      ^"),  # to the end of the line
        ("name: x", 99, 120, "name: x", "       ^"),  # behind the end
        ("", 1, 1, "", "^"),
        ("\tnam: x", 2, 5, "    nam: x", "    ^^^"),
        ("a\tnam: x", 3, 6, "a   nam: x", "    ^^^"),
        ("日本: nam", 5, 8, "日本: nam", "      ^^^"),  # wide characters take two cells
        ("nam: 日本", 6, 8, "nam: 日本", "     ^^^^"),
        ("e\u0301: nam", 5, 8, "e\u0301: nam", "   ^^^"),  # a combining accent takes none
        ("a\x1b[31m: b", 1, 2, "a\ufffd[31m: b", "^"),  # nothing of a file reaches the terminal as a command
        ("a\u202eb: c", 4, 5, "a\ufffdb: c", "   ^"),
        ("x   ", 1, 2, "x", "^"),
    ],
)
def test_marks(line: str, column: int, end_column: int | None, source: str, marks: str) -> None:
    shown = snippet(line, column, end_column)
    assert (shown.source, shown.marks) == (source, marks)


@pytest.mark.parametrize("column", [1, 20, 150, 500, 998])
def test_a_long_line_is_cut_around_the_mark(column: int) -> None:
    line = "." * (column - 1) + "bad" + "." * (1000 - column - 2)
    shown = snippet(line, column, column + 3)
    assert len(shown.source) <= 142
    assert shown.source[len(shown.marks) - 3 : len(shown.marks)] == "bad"


def test_a_long_span_is_cut_with_its_line() -> None:
    shown = snippet("x" * 1000, 1, 1001)
    assert shown.source.endswith("…")
    assert len(shown.marks) < len(shown.source)


@given(st.text(max_size=400), st.integers(1, 410), st.integers(0, 410))
def test_any_line_and_any_span_can_be_shown(line: str, column: int, width: int) -> None:
    shown = snippet(line, column, column + width)
    assert shown.marks.strip(" ").strip("^") == ""
    assert shown.marks.endswith("^")
    assert not any(unicodedata.category(character) in ("Cc", "Cf") for character in shown.source)
