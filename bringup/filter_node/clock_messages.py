"""Sets a node's clock from the bytes of /clock.

rclpy makes a message of each and a time of that, which costs more than everything else at a wake-up that brings
nothing but the time.
"""

from collections.abc import Callable
from struct import Struct
from typing import Any, TypeAlias

from rclpy.clock import ROSClock
from rclpy.clock_type import ClockType
from rclpy.serialization import deserialize_message
from rclpy.time import Time
from rclpy.time_source import TimeSource

Subscription: TypeAlias = Any

_CDR_LITTLE_ENDIAN = b"\x00\x01"
_ENCAPSULATION = 4
_STAMP = Struct("<iI")


def sets_the_clock(subscription: Subscription) -> bool:
    """Whether a subscription is the one by which rclpy follows simulated time, whatever its topic is called."""
    return getattr(subscription.callback, "__func__", None) is TimeSource.clock_callback


def clock_setter(subscription: Subscription, clock: ROSClock) -> Callable[[], None]:
    """Give what takes one message of such a subscription and sets the clock by it."""
    handle, kind = subscription.handle, subscription.msg_type

    def take() -> None:
        taken = handle.take_message(kind, True)
        if taken is None:
            return
        data = taken[0]
        if data.startswith(_CDR_LITTLE_ENDIAN):
            seconds, nanoseconds = _STAMP.unpack_from(data, _ENCAPSULATION)
            time = Time(seconds=seconds, nanoseconds=nanoseconds, clock_type=ClockType.ROS_TIME)
            clock.set_ros_time_override(time)
        else:
            subscription.callback(deserialize_message(data, kind))

    return take
