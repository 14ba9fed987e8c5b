"""Actions that keep their arguments as they are given are what their constructors make of them."""

from __future__ import annotations

import copy
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.compat import refusing
from orchestra.compat.building import model_of
from orchestra.compat.launch.actions import (
    DeclareLaunchArgument,
    GroupAction,
    IncludeLaunchDescription,
    LogInfo,
    SetEnvironmentVariable,
    SetLaunchConfiguration,
    UnsetEnvironmentVariable,
)
from orchestra.compat.launch.conditions import IfCondition
from orchestra.compat.launch.launch_description_sources import PythonLaunchDescriptionSource
from orchestra.compat.launch.substitutions import LaunchConfiguration, TextSubstitution
from orchestra.compat.launch_ros.actions import PushROSNamespace, SetParameter, SetRemap
from orchestra.compat.refusing import collecting
from orchestra.errors import Problems
from tests.compat.contexts import loading

if TYPE_CHECKING:
    from collections.abc import Iterator

_ROBOT = LaunchConfiguration("robot")
_FILE = PythonLaunchDescriptionSource("/a.launch.py")


@pytest.fixture(autouse=True, scope="module")
def _loading() -> Iterator[None]:
    with loading({"PATH": "/usr/bin:/bin"}):
        yield


def _both(kind: type[Any], *arguments: Any, **keywords: Any) -> tuple[Any, Any]:
    """Return what the constructor makes, and what keeps its arguments, from one place."""
    both = []
    with collecting(Problems(), ()):
        for keeping in ({}, refusing._keeping):
            with pytest.MonkeyPatch.context() as patch:
                patch.setattr(refusing, "_keeping", keeping)
                both.append(kind(*arguments, **keywords))
    made, kept = both
    assert made._as_given is None
    return made, kept


@pytest.mark.parametrize(
    ("kind", "arguments", "keywords"),
    [
        (SetRemap, ("scan", ["/", _ROBOT, "/scan"]), {}),
        (SetRemap, (), {"dst": "$(var a)", "src": _ROBOT}),
        (SetRemap, ("a", ("b", TextSubstitution(text="\\"))), {"condition": IfCondition("true")}),
        (PushROSNamespace, ([_ROBOT],), {}),
        (PushROSNamespace, ([],), {}),
        (SetLaunchConfiguration, ("a", ["b"]), {}),
        (SetLaunchConfiguration, ("a",), {"value": ""}),
        (SetEnvironmentVariable, (), {"name": "A", "value": [_ROBOT, ""]}),
        (UnsetEnvironmentVariable, ("A",), {}),
        (SetParameter, ("use_sim_time", True), {}),
        (SetParameter, (), {"name": [_ROBOT, ".a"], "value": "$(var b)"}),
        (SetParameter, ("rate",), {"value": 0.5}),
        (LogInfo, (), {"msg": ["robot: ", _ROBOT]}),
        (DeclareLaunchArgument, ("a",), {}),
        (DeclareLaunchArgument, ("a",), {"default_value": [_ROBOT, "/b"], "description": "c"}),
        (DeclareLaunchArgument, (), {"name": "a", "default_value": "b", "choices": ["b", "c"]}),
        (DeclareLaunchArgument, ("a",), {"default_value": None, "description": None, "choices": None}),
        (GroupAction, ([LogInfo(msg="a")],), {}),
        (GroupAction, (), {"actions": [], "scoped": False, "forwarding": False}),
        (GroupAction, ([],), {"scoped": True, "condition": IfCondition(_ROBOT)}),
        (IncludeLaunchDescription, (_FILE,), {}),
        (IncludeLaunchDescription, (_FILE,), {"launch_arguments": {"a": _ROBOT, "b": ["c", _ROBOT]}.items()}),
        (IncludeLaunchDescription, (_FILE,), {"launch_arguments": [("a", ""), ([_ROBOT], "$")]}),
    ],
)
def test_their_model_is_that_of_the_constructed_ones(
    kind: type[Any], arguments: tuple[Any, ...], keywords: dict[str, Any]
) -> None:
    made, kept = _both(kind, *arguments, **keywords)
    assert kept._as_given is not None
    model, other = model_of(kept), model_of(made)
    assert model.location(()) == other.location(())
    assert vars(model) == vars(other)
    assert not hasattr(kept, "_unknown")  # which constructs it
    assert {*vars(kept)} - {"_as_given", "_made_at"} == {*vars(made)}


@pytest.mark.parametrize(
    ("kind", "arguments", "keywords"),
    [
        (SetRemap, ("a", 5), {}),
        (SetRemap, ("a", "b", "c"), {}),
        (SetRemap, ("a", "b"), {"dst": "c"}),
        (SetRemap, ("a",), {}),
        (DeclareLaunchArgument, ("a",), {"default_value": "b", "choices": ["c"]}),
        (DeclareLaunchArgument, (["a"],), {}),
        (GroupAction, (), {}),
    ],
)
def test_what_is_wrong_is_for_the_constructor(
    kind: type[Any], arguments: tuple[Any, ...], keywords: dict[str, Any]
) -> None:
    with collecting(Problems(), ()):
        for _ in range(2):
            with pytest.raises((TypeError, RuntimeError)):
                kind(*arguments, **keywords)


def test_what_code_does_to_them_afterwards_counts() -> None:
    names = ["a", _ROBOT]
    made, kept = _both(SetRemap, "scan", names)
    names.append("later")
    assert model_of(kept).to == model_of(made).to  # type: ignore[attr-defined] # of a remapping
    kept.dst.append(TextSubstitution(text="x"))
    assert model_of(kept).to.raw == "a$(var robot)x"  # type: ignore[attr-defined] # as above
    _, kept = _both(SetRemap, "scan", "b")
    kept._SetRemap__dst = [TextSubstitution(text="mine")]
    assert copy.copy(kept).src[0].text == "scan"
    assert model_of(kept).to.raw == "mine"  # type: ignore[attr-defined] # as above
    _, kept = _both(GroupAction, [])
    kept._GroupAction__actions.append(LogInfo(msg="late"))
    assert len(model_of(kept).children) == 1  # type: ignore[attr-defined] # of a group
    _, kept = _both(DeclareLaunchArgument, "a", default_value="b", condition=IfCondition("true"))
    assert (kept.name, kept.default_value[0].text, kept.description) == ("a", "b", "no description given")
    assert kept.condition is not None


def test_classes_of_users_are_constructed() -> None:
    class Mine(SetRemap):
        pass

    assert _both(Mine, "a", "b")[1]._as_given is None
