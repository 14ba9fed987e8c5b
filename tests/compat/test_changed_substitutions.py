"""What code changes in a substitution counts in all that are made of it, as upstream."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from orchestra.compat.launch.substitutions import (
    LaunchConfiguration,
    PathJoinSubstitution,
    TextSubstitution,
)
from orchestra.compat.launch_ros.substitutions import FindPackageShare
from orchestra.compat.place import here
from orchestra.compat.refusing import collecting
from orchestra.compat.text import template
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


@pytest.mark.parametrize(
    ("make", "change"),
    [
        (lambda: LaunchConfiguration("robot"), _rename),
        (lambda: PathJoinSubstitution(["robot", "b"]), _move),
        (lambda: FindPackageShare("robot"), _repackage),
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
