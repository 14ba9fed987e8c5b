"""What code changes in a substitution counts in all that are made of it, as upstream."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from orchestra.compat.launch.conditions import IfCondition
from orchestra.compat.launch.substitutions import (
    EqualsSubstitution,
    IfElseSubstitution,
    LaunchConfiguration,
    NotSubstitution,
    PathJoinSubstitution,
    PythonExpression,
    TextSubstitution,
)
from orchestra.compat.launch_ros.substitutions import FindPackageShare
from orchestra.compat.place import here
from orchestra.compat.refusing import collecting
from orchestra.compat.text import shown, template
from orchestra.description.text import Words
from orchestra.errors import Problems
from tests.compat.contexts import loading

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


class _Text(str):
    __slots__ = ()


@pytest.fixture(autouse=True, scope="module")
def _loading() -> Iterator[None]:
    with loading({}):
        yield


def _rename(made: Any) -> None:
    made.variable_name[:] = [TextSubstitution(text="mode")]


def _move(made: Any) -> None:
    made.substitutions[:] = [TextSubstitution(text="mode")]


def _repackage(made: Any) -> None:
    made.package[:] = [TextSubstitution(text="mode")]


def _put(name: str) -> Callable[[Any], None]:
    """Return what code does that takes upstream's private names for its own, before anybody has asked for one."""
    return lambda made: setattr(made, name, [TextSubstitution(text="mode")])


@pytest.mark.parametrize(
    ("make", "change"),
    [
        (lambda: LaunchConfiguration("robot"), _rename),
        (lambda: LaunchConfiguration("robot"), _put("_LaunchConfiguration__variable_name")),
        (lambda: PathJoinSubstitution(["robot", "b"]), _move),
        (lambda: PathJoinSubstitution(["robot", "b"]), _put("_PathJoinSubstitution__substitutions")),
        (lambda: FindPackageShare("robot"), _repackage),
        (lambda: FindPackageShare("robot"), _put("_FindPackage__package")),
    ],
)
@pytest.mark.parametrize("is_listed", [False, True])
def test_what_stands_in_a_path_may_be_changed(
    make: Callable[[], Any], change: Callable[[Any], None], *, is_listed: bool
) -> None:
    with collecting(Problems(), ()):
        for _ in range(2):  # the second time arguments are kept as they are given
            inner = make()
            path = PathJoinSubstitution([["-", inner] if is_listed else inner, "x"])
            outer = PathJoinSubstitution(["a", path])
    assert path._as_given is not None
    assert "robot" in outer._whole().raw
    change(inner)
    texts = [template([outer, "y"], here().at("name"))]
    texts += [text for text in (outer._whole(), path._whole()) if text is not None or not is_listed]
    assert all("mode" in text.raw and "robot" not in text.raw for text in texts)
    assert not any("robot" in str(getattr(text, "pieces", None)) for text in texts)


def test_a_component_that_is_a_list_is_joined_without_anything_between() -> None:
    """What code does to its list afterwards changes nothing: the constructor has read it."""
    with collecting(Problems(), ()):
        for _ in range(2):  # as above
            listed: list[Any] = [LaunchConfiguration("robot"), ".yaml"]
            path = PathJoinSubstitution(["/a", listed, ["b"]])
            listed.append("x")
    assert path._as_given is not None
    whole: Any = path._whole()
    (joined,) = whole.pieces.pieces
    assert [list(component)[-1:] for component in joined.components] == [["/a"], [".yaml"], ["b"]]
    assert whole.raw == "$(path-join /a $(var robot).yaml b)"
    assert [item.describe() for item in path.substitutions] == [
        "'/a'",
        "LaunchConfig('robot') + '.yaml'",
        "'b'",
    ]


def test_a_text_of_a_class_of_its_own_is_a_text() -> None:
    with collecting(Problems(), ()):
        items = [LaunchConfiguration("mode"), TextSubstitution(text=_Text("t"))]
    made = template(items, here().at("name"))
    assert made.raw == "$(var mode)t"
    pieces: Any = getattr(made, "pieces", None)
    assert pieces is None or pieces.pieces[-1] == "t"
    assert made.parts[-1] == Words("t", made.parts[-1].span)


@pytest.mark.parametrize(
    ("make", "name"),
    [
        (
            lambda: PythonExpression(["'robot' == ", LaunchConfiguration("a")]),
            "_PythonExpression__expression",
        ),
        (lambda: EqualsSubstitution(LaunchConfiguration("robot"), "a"), "_TwoSided__left"),
        (lambda: NotSubstitution(LaunchConfiguration("robot")), "_NotSubstitution__value"),
        (lambda: IfElseSubstitution(LaunchConfiguration("a"), "robot", "b"), "_IfElseSubstitution__if_value"),
    ],
)
@pytest.mark.parametrize("is_seen", [False, True])
def test_what_code_puts_in_a_private_attribute_counts(
    make: Callable[[], Any], name: str, *, is_seen: bool
) -> None:
    with collecting(Problems(), ()):
        for _ in range(2):  # as above
            made = make()
            condition = IfCondition(made)
    assert made._as_given is not None
    if is_seen:
        assert "robot" in template([made], here().at("name")).raw
    _put(name)(made)
    (text,) = condition._fields(here().span).values()
    for raw in (text.raw, template([made], here().at("name")).raw):
        assert "mode" in raw
        assert "robot" not in raw
    _put("_IfCondition__expression")(condition)
    (text,) = condition._fields(here().span).values()
    assert text.raw == "mode"


def test_what_calculates_is_noted_while_nobody_is_shown_what_it_was_given() -> None:
    with collecting(Problems(), ()):
        variable = LaunchConfiguration("robot")
        made = [PythonExpression(["1 + ", variable]) for _ in range(2)][-1]
        around = NotSubstitution(made)
    assert (made._is_noted(), around._is_noted()) == (True, True)
    before = shown[0]
    assert made.expression
    assert shown[0] > before
    assert (made._is_noted(), around._is_noted()) == (False, False)
