"""Reads sensors' messages as they come over the wire.

A header, perhaps a child frame, and then nothing but doubles: taking them out of the bytes costs a tenth of what
rclpy needs to make a message object of them, and messages are most of what a filter does. The layout is that of
CDR (OMG DDSI-RTPS 10.2, XCDR1): four bytes that say so, then values, each aligned to its own size. Bytes of another
encoding go through rclpy.
"""

from collections.abc import Callable
from struct import Struct

from geometry_msgs.msg import PoseWithCovarianceStamped, TwistWithCovarianceStamped
from nav_msgs.msg import Odometry
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import Imu

from bringup.filter.readings import Heard, Message, heard, stamp_of
from bringup.filter.settings import NANOSECONDS, Kind
from bringup.filter.transforms import Sample
from orchestra.ros.interfaces import tf_message_type

MESSAGE_TYPES: dict[Kind, type] = {
    "odom": Odometry,
    "pose": PoseWithCovarianceStamped,
    "twist": TwistWithCovarianceStamped,
    "imu": Imu,
}
# How many doubles follow the header (and, in odometry, the child frame).
_NUMBERS: dict[Kind, int] = {"odom": 85, "pose": 43, "twist": 42, "imu": 37}

_CDR_LITTLE_ENDIAN = b"\x00\x01"
_ENCAPSULATION = 4
_DOUBLE = 8
_STAMP = Struct("<iI")
_FRAMES = _ENCAPSULATION + _STAMP.size
_HEADER = Struct("<iII")
_LENGTH = Struct("<I")
_TRANSFORM = Struct("<7d")


def reader(kind: Kind) -> Callable[[bytes], Heard]:
    """Give what reads serialised messages of a kind.

    The frames of a sensor hardly ever change: as long as their bytes stay the same, so does the place of the numbers.
    """
    numbers, has_child = Struct(f"<{_NUMBERS[kind]}d"), kind == "odom"
    frame = child = ""
    texts, start = b"", _FRAMES

    def read(data: bytes) -> Heard:
        nonlocal frame, child, texts, start
        if not data.startswith(_CDR_LITTLE_ENDIAN):
            return heard(kind, deserialize_message(data, MESSAGE_TYPES[kind]))
        if not texts or data[_FRAMES:start] != texts:
            frame, child, start = _frames(data, has_child=has_child)
            texts = data[_FRAMES:start]
        seconds, nanoseconds = _STAMP.unpack_from(data, _ENCAPSULATION)
        stamp = seconds * NANOSECONDS + nanoseconds
        return Heard(stamp, frame, child, numbers.unpack_from(data, start))

    return read


def _frames(data: bytes, *, has_child: bool) -> tuple[str, str, int]:
    """Read the frame and the child frame, if there is one, and say where the numbers begin."""
    frame, end = _text(data, _FRAMES + _LENGTH.size, _LENGTH.unpack_from(data, _FRAMES)[0])
    child = ""
    if has_child:
        start = _aligned(end, _LENGTH.size)
        child, end = _text(data, start + _LENGTH.size, _LENGTH.unpack_from(data, start)[0])
    return frame, child, _aligned(end, _DOUBLE)


def transforms(data: bytes) -> list[tuple[str, str, Sample]]:
    """Read a serialised tf2_msgs/TFMessage: parent, child, and where the child stands in the parent."""
    if not data.startswith(_CDR_LITTLE_ENDIAN):
        return edges(deserialize_message(data, tf_message_type()))
    (count,) = _LENGTH.unpack_from(data, _ENCAPSULATION)
    found, end = [], _ENCAPSULATION + _LENGTH.size
    for _ in range(count):
        start = _aligned(end, _LENGTH.size)
        seconds, nanoseconds, length = _HEADER.unpack_from(data, start)
        parent, end = _text(data, start + _HEADER.size, length)
        start = _aligned(end, _LENGTH.size)
        child, end = _text(data, start + _LENGTH.size, _LENGTH.unpack_from(data, start)[0])
        start = _aligned(end, _DOUBLE)
        x, y, z, qx, qy, qz, qw = _TRANSFORM.unpack_from(data, start)
        end = start + _TRANSFORM.size
        sample = Sample(seconds * NANOSECONDS + nanoseconds, (x, y, z), (qx, qy, qz, qw))
        found.append((parent, child, sample))
    return found


def edges(message: Message) -> list[tuple[str, str, Sample]]:
    """Read a tf2_msgs/TFMessage."""
    return [_edge(stamped) for stamped in message.transforms]


def _edge(stamped: Message) -> tuple[str, str, Sample]:
    place, turn = stamped.transform.translation, stamped.transform.rotation
    sample = Sample(stamp_of(stamped), (place.x, place.y, place.z), (turn.x, turn.y, turn.z, turn.w))
    return stamped.header.frame_id.lstrip("/"), stamped.child_frame_id.lstrip("/"), sample


def _text(data: bytes, start: int, length: int) -> tuple[str, int]:
    """Read a string, which ends with a zero, and say where it ends."""
    end = start + length
    return data[start : end - 1].decode().lstrip("/"), end


def _aligned(place: int, size: int) -> int:
    return _ENCAPSULATION + -(-(place - _ENCAPSULATION) // size) * size
