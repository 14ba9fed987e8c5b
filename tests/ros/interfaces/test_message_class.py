"""TFMessage as a class: what generic tools and users find is what they find on every other message."""

from __future__ import annotations

import copy
from typing import Any

import pytest
from geometry_msgs.msg import PoseStamped, TransformStamped
from nav_msgs.msg import Path
from rosidl_parser.definition import NamespacedType, UnboundedSequence

from orchestra.ros.interfaces.tf2 import TFMessage


def _named(child: str) -> TransformStamped:
    return TransformStamped(child_frame_id=child)


def test_a_new_message_is_empty() -> None:
    assert TFMessage().transforms == []
    assert TFMessage().transforms is not TFMessage().transforms


def test_messages_are_equal_by_value_and_have_no_hash() -> None:
    assert TFMessage(transforms=[_named("odom")]) == TFMessage(transforms=[_named("odom")])
    assert TFMessage(transforms=[_named("odom")]) != TFMessage(transforms=[_named("map")])
    assert TFMessage() != Path()
    with pytest.raises(TypeError, match="unhashable"):
        hash(TFMessage())


def test_a_message_is_written_like_the_others() -> None:
    message = TFMessage(transforms=[_named("odom")])
    assert repr(message) == f"tf2_msgs.msg.TFMessage(transforms=[{_named('odom')!r}])"


def test_copies_share_nothing() -> None:
    message = TFMessage(transforms=[_named("odom")])
    other = copy.deepcopy(message)
    other.transforms[0].child_frame_id = "map"
    assert message == TFMessage(transforms=[_named("odom")])


def test_fields_and_their_types_are_told() -> None:
    assert TFMessage.get_fields_and_field_types() == {
        "transforms": "sequence<geometry_msgs/TransformStamped>"
    }
    TFMessage.get_fields_and_field_types().clear()
    assert TFMessage.get_fields_and_field_types()
    (slot,) = TFMessage.SLOT_TYPES
    assert isinstance(slot, UnboundedSequence)
    assert slot.value_type == NamespacedType(["geometry_msgs", "msg"], "TransformStamped")


def test_a_generic_tool_reads_it_like_any_message() -> None:
    message = TFMessage(transforms=[_named("odom")])
    assert _as_mapping(message)["transforms"][0] == _as_mapping(_named("odom"))
    assert _type_name(message) == "tf2_msgs/msg/TFMessage"
    assert _type_name(Path()) == "nav_msgs/msg/Path"


def _as_mapping(value: Any) -> Any:
    """Do what `topic echo` does: walk the fields that a message tells."""
    if isinstance(value, list):
        return [_as_mapping(item) for item in value]
    if not hasattr(value, "get_fields_and_field_types"):
        return value
    return {name: _as_mapping(getattr(value, name)) for name in value.get_fields_and_field_types()}


def _type_name(message: Any) -> str:
    package, kind, _ = type(message).__module__.split(".")
    return f"{package}/{kind}/{type(message).__name__}"


def test_a_path_and_a_tf_message_have_the_same_members() -> None:
    """Path stands for every generated class."""
    public = {name for name in dir(Path) if not name.startswith("__")} - {
        "_header",
        "header",
        "_poses",
        "poses",
    }
    assert public <= {name for name in dir(TFMessage) if not name.startswith("__")}


@pytest.mark.parametrize(
    "value",
    [5, "odom", [PoseStamped()], [None], {"transforms": []}, iter([])],
    ids=lambda value: type(value).__name__,
)
def test_a_wrong_field_is_refused_where_fields_are_checked(value: object) -> None:
    with pytest.raises(AssertionError, match="'transforms' field must be a set or sequence"):
        TFMessage(transforms=value, check_fields=True)
    message = TFMessage(check_fields=True)
    with pytest.raises(AssertionError):
        message.transforms = value
    assert TFMessage(transforms=value).transforms is value


@pytest.mark.parametrize("value", [[], (), [TransformStamped()], (TransformStamped(),)], ids=repr)
def test_a_right_field_passes_the_check(value: object) -> None:
    assert TFMessage(transforms=value, check_fields=True).transforms is value


def test_an_unknown_field_is_refused_where_fields_are_checked() -> None:
    with pytest.raises(AssertionError, match="Invalid arguments passed to constructor: poses"):
        TFMessage(poses=[], check_fields=True)
    assert TFMessage(poses=[]) == TFMessage()
