from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Code

if TYPE_CHECKING:
    from tests.resolve.texts.conftest import Place


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("$(path-join a b c)", "a/b/c"),
        ("$(path-join a/ b)", "a/b"),
        ("$(path-join a /b c)", "/b/c"),
        ("$(path-join a '')", "a/"),
        ("$(path-join a)", "a"),
        ("$(path-join $(var a) $(var a)b)", "A/Ab"),
        ("$(string-join , a b c)", "a,b,c"),
        ("$(string-join ' and ' a b)", "a and b"),
        ("$(string-join '' a b)", "ab"),
        ("$(string-join ,)", ""),
        ("$(string-join $(var a) 1 2)", "1A2"),
    ],
)
def test_parts_are_joined(text: str, value: str, place: Place) -> None:
    assert place.value(text) == value
    assert not len(place.problems)


@pytest.mark.parametrize("text", ["$(path-join a $(var missing))", "$(string-join , $(var missing))"])
def test_a_part_that_is_faulty_is_told_once(text: str, place: Place) -> None:
    assert place.value(text) is None
    assert [problem.code for problem in place.problems] == [Code.UNDEFINED_VARIABLE]


@pytest.mark.parametrize("text", ["$(path-join)", "$(string-join)"])
def test_there_is_something_to_join(text: str, place: Place) -> None:
    assert place.value(text) is None
    assert [problem.code for problem in place.problems] == [Code.SUBSTITUTION_SYNTAX]
