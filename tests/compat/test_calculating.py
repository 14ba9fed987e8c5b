"""Substitutions that calculate are, by their skeleton, what they are part by part."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orchestra.compat.calculating import Calculating
from orchestra.compat.launch.condition import Condition
from orchestra.compat.launch.conditions import IfCondition, UnlessCondition
from orchestra.compat.launch.substitutions import (
    AllSubstitution,
    AndSubstitution,
    AnySubstitution,
    EnvironmentVariable,
    EqualsSubstitution,
    IfElseSubstitution,
    LaunchConfiguration,
    NotEqualsSubstitution,
    NotSubstitution,
    OrSubstitution,
    PythonExpression,
    TextSubstitution,
)
from orchestra.compat.parsed import ParsedSubstitution
from orchestra.compat.refusing import collecting
from orchestra.description.calculated import Calculated
from orchestra.description.text import MatchedTemplate
from orchestra.errors import Problems
from orchestra.location import point
from tests.compat.contexts import loading

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from orchestra.compat.launch.launch_context import LaunchContext

_SPAN = point("here")
_TEXTS = (
    "'",
    "' == 'sim'",
    "true",
    "12",
    "0 < 7.5",
    "",
    " ",
    "a b",
    "100%",
    "$x",
    "\\1",
    "ü",
    "\x01",
    "\n",
    "(",
)


class _Shouting(PythonExpression):
    def perform(self, context: LaunchContext) -> str:
        return super().perform(context).upper()


@pytest.fixture(autouse=True, scope="module")
def _loading() -> Iterator[None]:
    with loading({}):
        yield


def _leaves() -> st.SearchStrategy[Any]:
    return st.one_of(
        st.sampled_from(_TEXTS),
        st.builds(LaunchConfiguration, st.sampled_from(("mode", "robot_12", "", "$x"))),
        st.builds(LaunchConfiguration, st.just("mode"), default=st.sampled_from(_TEXTS)),
        st.builds(lambda text: TextSubstitution(text=text), st.sampled_from(_TEXTS)),
        st.builds(EnvironmentVariable, st.just("HOME")),
    )


def _calls(inner: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    several = st.one_of(inner, st.lists(inner, min_size=1, max_size=4))
    two_sided = (EqualsSubstitution, NotEqualsSubstitution, AndSubstitution, OrSubstitution)
    return st.one_of(
        st.builds(PythonExpression, several),
        st.builds(PythonExpression, several, st.sampled_from((["math"], "os", ["math", "os"]))),
        st.builds(_Shouting, several),
        st.builds(NotSubstitution, several),
        st.builds(lambda kind, one, other: kind(one, other), st.sampled_from(two_sided), several, several),
        st.builds(
            lambda kind, values: kind(*values),
            st.sampled_from((AnySubstitution, AllSubstitution)),
            st.lists(several, max_size=3),
        ),
        st.builds(IfElseSubstitution, several, several, st.just("no")),
    )


_ANY = _calls(st.recursive(_leaves(), _calls, max_leaves=6))


@given(_ANY)
def test_what_is_known_by_its_skeleton_is_what_its_parts_are(made: Any) -> None:
    by_skeleton, by_parts = made._whole(), _by_parts(made)
    assert by_skeleton == by_parts
    if by_parts is not None:
        assert by_skeleton.constant == by_parts.constant
        assert by_skeleton.span == by_parts.span


def _by_parts(made: Any) -> Any:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Calculating, "_whole", ParsedSubstitution._whole)
        return made._whole()


def _calculated(made: Any) -> bool:
    whole = made._whole()
    return type(whole) is MatchedTemplate and isinstance(whole.pieces, Calculated)


@pytest.mark.parametrize(
    "made",
    [
        lambda: PythonExpression(["'", LaunchConfiguration("mode"), "' == 'sim' and 12 < 30"]),
        lambda: NotSubstitution(LaunchConfiguration("mode")),
        lambda: AndSubstitution(EqualsSubstitution(LaunchConfiguration("mode"), "1"), "true"),
        lambda: AnySubstitution(LaunchConfiguration("a"), ["b", LaunchConfiguration("c")], args=["true"]),
    ],
)
def test_plain_ones_are_known_by_their_skeleton(made: Any) -> None:
    assert _calculated(made())


@pytest.mark.parametrize(
    "made",
    [
        lambda: _Shouting("1"),
        lambda: NotSubstitution(_Shouting("1")),
        lambda: PythonExpression("'\x02' == '\x03'"),
        lambda: NotSubstitution(EnvironmentVariable("X")),
        lambda: PythonExpression(["1"] * 400),
    ],
)
def test_others_are_taken_apart(made: Any) -> None:
    assert not _calculated(made())


_SIDES = (
    "sim",
    LaunchConfiguration("mode"),
    ["a", LaunchConfiguration("mode")],
    NotSubstitution("true"),
    TextSubstitution(text="x"),
)
_MADE: tuple[Callable[[Any, Any], Any], ...] = (
    lambda one, _: PythonExpression(one),
    lambda one, _: NotSubstitution(one),
    AndSubstitution,
    OrSubstitution,
    EqualsSubstitution,
    NotEqualsSubstitution,
    AnySubstitution,
    AllSubstitution,
    lambda one, other: IfElseSubstitution(one, other, "no"),
    lambda one, other: IfCondition(AndSubstitution(one, other)),
    lambda one, _: UnlessCondition(NotSubstitution(one)),
)


@pytest.mark.parametrize("make", _MADE)
@pytest.mark.parametrize("one", _SIDES)
@pytest.mark.parametrize("other", _SIDES)
def test_what_keeps_its_arguments_is_what_the_constructor_makes(make: Any, one: Any, other: Any) -> None:
    with collecting(Problems(), ()):
        made, kept = [make(one, other) for _ in range(2)]
    told = made.describe()  # it is constructed, at the latest now
    assert made._as_given is None
    is_kept = kept._as_given is not None
    assert is_kept != (
        type(one) is type(other) is str and make in (EqualsSubstitution, NotEqualsSubstitution)
    )
    if isinstance(made, Condition):
        assert kept._fields(_SPAN) == made._fields(_SPAN)
    else:
        assert kept._whole() == made._whole()
    assert kept._place.span == made._place.span
    assert (kept._as_given is not None) is is_kept
    assert kept.describe() == told
    assert kept._as_given is None


def test_a_list_that_is_kept_is_one_of_its_own() -> None:
    given = ["1", " < 2"]
    with collecting(Problems(), ()):
        _, kept = [PythonExpression(given) for _ in range(2)]
    given.append("0")
    assert kept._whole().raw == "$(eval '1 < 2')"
    assert [item.text for item in kept.expression] == ["1", " < 2"]


@pytest.mark.parametrize("kind", [EqualsSubstitution, NotEqualsSubstitution])
@pytest.mark.parametrize("side", [["r1"], ["r", "1"], []])
def test_a_list_of_texts_alone_is_a_value_that_is_compared_as_it_is_shown(kind: Any, side: list[str]) -> None:
    with collecting(Problems(), ()):
        made, kept = [kind(side, LaunchConfiguration("robot")) for _ in range(2)]
    assert made._whole() == kept._whole()
    assert [item.text for item in kept.left] == [str(side)]


def test_a_subclass_of_a_launch_file_is_constructed() -> None:
    with collecting(Problems(), ()):
        made = [_Shouting("1") for _ in range(3)]
    assert all(item._as_given is None for item in made)


def test_what_performs_a_class_may_be_replaced(monkeypatch: pytest.MonkeyPatch) -> None:
    made = NotSubstitution(LaunchConfiguration("mode"))
    assert _calculated(made)
    monkeypatch.setattr(LaunchConfiguration, "perform", lambda _self, _context: "x")
    assert not _calculated(made)
    monkeypatch.undo()
    monkeypatch.setattr(NotSubstitution, "perform", lambda _self, _context: "x")
    assert not _calculated(made)


def test_what_code_puts_into_a_list_counts_from_then_on() -> None:
    expression = PythonExpression(["'a' == 'b'"])
    before = expression._whole()
    expression.expression.append(TextSubstitution(text=" or True"))
    after = expression._whole()
    assert before is not None
    assert after is not None
    assert before.raw == "$(eval '\\'a\\' == \\'b\\'')"
    assert after.raw == "$(eval '\\'a\\' == \\'b\\' or True')"
    assert before.parts != after.parts
