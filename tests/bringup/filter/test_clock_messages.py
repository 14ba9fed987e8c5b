"""A node's clock is set by the bytes of /clock as rclpy sets it by messages."""

from collections.abc import Iterator

import pytest
import rclpy
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.serialization import serialize_message
from rclpy.signals import SignalHandlerOptions
from rosgraph_msgs.msg import Clock

from bringup.filter_node.clock_messages import clock_setter, sets_the_clock

# lark, which the ROS wheels load, still imports a module that Python 3.11 has renamed.
pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")


@pytest.fixture
def node() -> Iterator[Node]:
    context = rclpy.Context()
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        rclpy.init(context=context, domain_id=158, signal_handler_options=SignalHandlerOptions.NO)
    simulated = Parameter("use_sim_time", value=True)
    remapped = ["--ros-args", "-r", "/clock:=/elsewhere"]
    node = rclpy.create_node(
        "clocked",
        context=context,
        parameter_overrides=[simulated],
        cli_args=remapped,
        use_global_arguments=False,
    )
    yield node
    node.destroy_node()
    rclpy.shutdown(context=context)


class _Taken:
    """Stands for a subscription in which one message waits: what middleware delivers when is not the point here."""

    msg_type = Clock

    def __init__(self, node: Node, data: bytes | None) -> None:
        self.handle = self
        self.callback = next(each for each in node.subscriptions if sets_the_clock(each)).callback
        self._data = data

    def take_message(self, kind: type, raw: bool) -> tuple[bytes, None] | None:
        assert (kind, raw) == (Clock, True)
        return None if self._data is None else (self._data, None)


def test_the_clock_is_found_whatever_its_topic_is_called(node: Node) -> None:
    node.create_subscription(Clock, "/clock", lambda _: None, 1)
    topics = [each.topic_name for each in node.subscriptions if sets_the_clock(each)]
    assert topics == ["/elsewhere"]


@pytest.mark.parametrize("seconds", [0, 1, 2**31 - 1])
def test_bytes_set_the_clock(node: Node, seconds: int) -> None:
    message = Clock()
    message.clock.sec, message.clock.nanosec = seconds, 999_999_999
    clock_setter(_Taken(node, serialize_message(message)), node.get_clock())()
    assert node.get_clock().now().nanoseconds == seconds * 1_000_000_000 + 999_999_999


def test_another_encoding_is_left_to_rclpy(node: Node, monkeypatch: pytest.MonkeyPatch) -> None:
    message = Clock()
    message.clock.sec = 7
    monkeypatch.setattr(
        "bringup.filter_node.clock_messages.deserialize_message", lambda _data, _kind: message
    )
    clock_setter(_Taken(node, b"\x00\x00\x00\x00"), node.get_clock())()
    assert node.get_clock().now().nanoseconds == 7_000_000_000


def test_without_a_message_the_time_stays(node: Node) -> None:
    before = node.get_clock().now().nanoseconds
    clock_setter(_Taken(node, None), node.get_clock())()
    assert node.get_clock().now().nanoseconds == before
