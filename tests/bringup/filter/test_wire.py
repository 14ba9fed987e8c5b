"""Serialised messages are read as rclpy reads them."""

from typing import Any

import numpy as np
import pytest
from geometry_msgs.msg import TransformStamped
from hypothesis import given, settings
from hypothesis import strategies as st
from rclpy.serialization import serialize_message

from bringup.filter.readings import heard
from bringup.filter.settings import Kind
from bringup.filter_node.wire import MESSAGE_TYPES, edges, reader, transforms
from orchestra.ros.interfaces import tf_message_type

# lark, which the ROS wheels load, still imports a module that Python 3.11 has renamed.
pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")

NUMBER = st.floats(allow_nan=False)
FRAME = st.text(st.characters(codec="utf-8", exclude_characters="\x00"), max_size=20)


def _fill(message: Any, draw: st.DataObject) -> None:
    """Put anything in every field that a message has, however deep."""
    for name, kind in message.get_fields_and_field_types().items():
        value = getattr(message, name)
        if kind == "string":
            setattr(message, name, draw.draw(FRAME))
        elif kind == "double":
            setattr(message, name, draw.draw(NUMBER))
        elif kind.startswith("double["):
            value[:] = draw.draw(st.lists(NUMBER, min_size=len(value), max_size=len(value)))
        elif kind in {"int32", "uint32"}:
            setattr(message, name, draw.draw(st.integers(0, 2**31 - 1)))
        else:
            _fill(value, draw)


@pytest.mark.parametrize("kind", MESSAGE_TYPES)
@given(st.data())
@settings(max_examples=20)
def test_bytes_say_what_the_message_says(kind: Kind, data: st.DataObject) -> None:
    """One reader for several messages: it remembers frames as long as they stay the same."""
    read_bytes, message = reader(kind), MESSAGE_TYPES[kind]()
    for again in (False, True, False):
        if not again:
            _fill(message, data)
        read, told = read_bytes(serialize_message(message)), heard(kind, message)
        assert (read.stamp, read.frame, read.child) == (told.stamp, told.frame, told.child)
        assert np.array_equal(read.numbers, told.numbers)


def test_a_frame_of_the_same_length_is_another_frame() -> None:
    read, message = reader("odom"), MESSAGE_TYPES["odom"]()
    for frame, child in (("aaa", "bbb"), ("aaa", "ccc"), ("ddd", "ccc"), ("aaaa", "bb")):
        message.header.frame_id, message.child_frame_id = frame, child
        said = read(serialize_message(message))
        assert (said.frame, said.child) == (frame, child)


@given(st.data(), st.integers(0, 4))
@settings(max_examples=20)
def test_transforms_are_read_from_their_bytes(data: st.DataObject, count: int) -> None:
    message = tf_message_type()()
    message.transforms = [TransformStamped() for _ in range(count)]
    for stamped in message.transforms:
        _fill(stamped, data)
    assert transforms(serialize_message(message)) == edges(message)


@pytest.mark.parametrize("kind", MESSAGE_TYPES)
def test_another_encoding_is_left_to_rclpy(kind: Kind, monkeypatch: pytest.MonkeyPatch) -> None:
    message = MESSAGE_TYPES[kind]()
    message.header.frame_id = "/there"
    monkeypatch.setattr("bringup.filter_node.wire.deserialize_message", lambda _data, _kind: message)
    assert reader(kind)(b"\x00\x00\x00\x00").frame == "there"
