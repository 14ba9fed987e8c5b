"""Texts are split into words as `shlex.split` does it."""

from __future__ import annotations

import shlex

from hypothesis import given
from hypothesis import strategies as st

from orchestra.convert.argv import split

_LONG = 5_000_000


def _parted(text: str) -> list[str] | str:
    try:
        return shlex.split(text)
    except ValueError as error:
        return str(error)


@given(st.text("ab'\"\\ \t\n\r\x0b#$\u2003", max_size=20))
def test_it_is_what_the_shell_makes_of_it(text: str) -> None:
    expected = _parted(text)
    try:
        found: list[str] | str = split(text)
    except ValueError as error:
        found = str(error)
    assert type(found) is type(expected)
    assert found == expected or isinstance(found, str)


def test_a_long_word_takes_time_in_proportion() -> None:
    """In the square of its length this would take minutes, which no test has."""
    for text in ("x" * _LONG, f"'{'x' * _LONG}'", f'"{"x" * _LONG}"', "\\x" * (_LONG // 100)):
        (word,) = split(text)
        assert set(word) == {"x"}
