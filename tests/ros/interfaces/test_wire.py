"""What is sent is what every other ROS 2 program sends: compared with an independent implementation of CDR."""

from __future__ import annotations

import math
import struct
from typing import Any

import pytest
from geometry_msgs.msg import TransformStamped
from hypothesis import given
from hypothesis import strategies as st
from rclpy.serialization import deserialize_message, serialize_message
from rosbags.typesys import Stores, get_typestore

from orchestra.ros.interfaces import wire
from orchestra.ros.interfaces.tf2 import TFMessage

_STORE = get_typestore(Stores.ROS2_JAZZY)
_NAME = "tf2_msgs/msg/TFMessage"

_names = st.text(st.characters(blacklist_categories=["Cs"], blacklist_characters="\0"), max_size=12)
_numbers = st.floats(allow_nan=False)


@st.composite
def _transforms(draw: st.DrawFn) -> TransformStamped:
    transform = TransformStamped()
    transform.header.stamp.sec = draw(st.integers(-(2**31), 2**31 - 1))
    transform.header.stamp.nanosec = draw(st.integers(0, 2**32 - 1))
    transform.header.frame_id = draw(_names)
    transform.child_frame_id = draw(_names)
    move, turn = transform.transform.translation, transform.transform.rotation
    move.x, move.y, move.z = draw(_numbers), draw(_numbers), draw(_numbers)
    turn.x, turn.y, turn.z, turn.w = draw(_numbers), draw(_numbers), draw(_numbers), draw(_numbers)
    return transform


def _messages(most: int = 6) -> st.SearchStrategy[TFMessage]:
    return st.lists(_transforms(), max_size=most).map(lambda transforms: TFMessage(transforms=transforms))


def _in_other_words(message: TFMessage) -> Any:
    """Return the message as the independent implementation has it."""
    types = _STORE.types
    return types[_NAME](
        [
            types["geometry_msgs/msg/TransformStamped"](
                types["std_msgs/msg/Header"](
                    types["builtin_interfaces/msg/Time"](item.header.stamp.sec, item.header.stamp.nanosec),
                    item.header.frame_id,
                ),
                item.child_frame_id,
                types["geometry_msgs/msg/Transform"](
                    _with(types["geometry_msgs/msg/Vector3"], item.transform.translation, "xyz"),
                    _with(types["geometry_msgs/msg/Quaternion"], item.transform.rotation, "xyzw"),
                ),
            )
            for item in message.transforms
        ]
    )


def _with(kind: Any, source: Any, fields: str) -> Any:
    return kind(*(getattr(source, field) for field in fields))


@given(_messages())
def test_what_is_sent_comes_back(message: TFMessage) -> None:
    assert deserialize_message(serialize_message(message), TFMessage) == message


@given(_messages())
def test_the_bytes_are_those_of_another_implementation(message: TFMessage) -> None:
    assert serialize_message(message) == bytes(_STORE.serialize_cdr(_in_other_words(message), _NAME))


@given(_messages())
def test_either_byte_order_is_read(message: TFMessage) -> None:
    foreign = bytes(_STORE.serialize_cdr(_in_other_words(message), _NAME, little_endian=False))
    assert deserialize_message(foreign, TFMessage) == message


@given(_messages(3), st.data())
def test_cut_bytes_are_refused(message: TFMessage, data: st.DataObject) -> None:
    whole = serialize_message(message)
    cut = whole[: data.draw(st.integers(0, len(whole) - 1))]
    with pytest.raises(wire.MalformedMessageError):
        wire.decode(cut, TransformStamped)


@given(st.binary(max_size=200))
def test_any_bytes_are_a_message_or_refused(content: bytes) -> None:
    try:
        transforms = wire.decode(b"\0\1\0\0" + content, TransformStamped)
    except wire.MalformedMessageError:
        return
    assert len(transforms) == struct.unpack_from("<I", content)[0]


@pytest.mark.parametrize("header", [b"", b"\0", b"\0\1\0", b"\0\3\0\0", b"\0\7\0\0", b"\1\1\0\0"])
def test_another_encoding_is_refused(header: bytes) -> None:
    with pytest.raises(wire.MalformedMessageError, match="plain CDR"):
        wire.decode(header, TransformStamped)


def test_numbers_that_are_no_numbers_pass() -> None:
    transform = TransformStamped()
    transform.transform.translation.x, transform.transform.translation.y = math.nan, -math.inf
    move = wire.decode(wire.encode([transform]), TransformStamped)[0].transform.translation
    assert math.isnan(move.x)
    assert move.y == -math.inf


def test_a_string_ends_at_its_first_nul_as_in_every_message() -> None:
    transform = TransformStamped(child_frame_id="odom\0rest")
    assert wire.decode(wire.encode([transform]), TransformStamped)[0].child_frame_id == "odom"


def test_an_integer_is_sent_as_the_number_that_it_is() -> None:
    transform = TransformStamped()
    transform.transform.translation.x = 5
    assert wire.decode(wire.encode([transform]), TransformStamped)[0].transform.translation.x == 5.0


def test_bytes_that_are_no_text_are_read_with_replacements() -> None:
    sent = wire.encode([TransformStamped(child_frame_id="odom")]).replace(b"odom", b"od\xffm")
    assert wire.decode(sent, TransformStamped)[0].child_frame_id == "od\ufffdm"


def test_a_thousand_transforms_pass() -> None:
    transforms = [TransformStamped(child_frame_id=f"frame{number}") for number in range(1000)]
    message = TFMessage(transforms=transforms)
    assert deserialize_message(serialize_message(message), TFMessage) == message
