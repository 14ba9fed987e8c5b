"""The type support in one process: what the middleware is told, what runs under its locks, and whose memory it is."""

from __future__ import annotations

import signal
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.executors import SingleThreadedExecutor
from rclpy.serialization import deserialize_message, serialize_message
from type_description_interfaces.srv import GetTypeDescription

from orchestra.ros.interfaces import conversion, layouts, typesupport
from orchestra.ros.interfaces.tf2 import TFMessage

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from rclpy.node import Node

# As `ros2 topic info --verbose /tf` shows it on every ROS 2 Jazzy.
_HASH = "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087"
_DOMAIN = 52


@pytest.fixture
def node(monkeypatch: pytest.MonkeyPatch) -> Iterator[Node]:
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    context = rclpy.Context()
    rclpy.init(context=context, domain_id=_DOMAIN)
    node = rclpy.create_node(
        "tf_test",
        context=context,
        parameter_overrides=[rclpy.Parameter("start_type_description_service", value=True)],
    )
    yield node
    node.destroy_node()
    rclpy.shutdown(context=context)


def _spin(node: Node, until: Callable[[], object]) -> None:
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    for _ in range(300):
        if until():
            break
        executor.spin_once(timeout_sec=0.1)
    executor.shutdown()
    assert until()


def _message(count: int) -> TFMessage:
    return TFMessage(
        transforms=[TransformStamped(child_frame_id=f"frame{number}") for number in range(count)]
    )


def test_the_graph_shows_the_upstream_type_and_hash(node: Node) -> None:
    node.create_publisher(TFMessage, "/tf", 10)
    _spin(node, lambda: node.get_publishers_info_by_topic("/tf"))
    (info,) = node.get_publishers_info_by_topic("/tf")
    assert info.topic_type == "tf2_msgs/msg/TFMessage"
    assert str(info.topic_type_hash) == _HASH


def test_the_node_describes_the_type(node: Node) -> None:
    node.create_publisher(TFMessage, "/tf", 10)
    client = node.create_client(GetTypeDescription, "/tf_test/get_type_description")
    _spin(node, client.service_is_ready)
    request = GetTypeDescription.Request(
        type_name="tf2_msgs/msg/TFMessage", type_hash=_HASH, include_type_sources=True
    )
    future = client.call_async(request)
    _spin(node, future.done)
    response = future.result()
    assert response.successful, response.failure_reason
    described = response.type_description
    assert described.type_description.type_name == "tf2_msgs/msg/TFMessage"
    (field,) = described.type_description.fields
    assert (field.name, field.type.type_id) == ("transforms", 145)
    assert field.type.nested_type_name == "geometry_msgs/msg/TransformStamped"
    assert [referenced.type_name for referenced in described.referenced_type_descriptions] == [
        "builtin_interfaces/msg/Time",
        "geometry_msgs/msg/Quaternion",
        "geometry_msgs/msg/Transform",
        "geometry_msgs/msg/TransformStamped",
        "geometry_msgs/msg/Vector3",
        "std_msgs/msg/Header",
    ]
    sources = {source.type_name: source.raw_file_contents for source in response.type_sources}
    assert sources["tf2_msgs/msg/TFMessage"] == "geometry_msgs/TransformStamped[] transforms\n"
    assert "geometry_msgs/msg/TransformStamped" in sources
    assert len(sources) == 7


@pytest.mark.parametrize("count", [0, 1, 1000])
def test_messages_arrive(node: Node, count: int) -> None:
    received: list[TFMessage] = []
    node.create_subscription(TFMessage, "/tf", received.append, 10)
    publisher = node.create_publisher(TFMessage, "/tf", 10)
    _spin(node, publisher.get_subscription_count)
    publisher.publish(_message(count))
    _spin(node, lambda: received)
    assert received == [_message(count)]


def test_what_arrives_can_be_sent_on(node: Node) -> None:
    received: list[TFMessage] = []
    node.create_subscription(TFMessage, "/tf", received.append, 10)
    publisher = node.create_publisher(TFMessage, "/tf", 10)
    _spin(node, publisher.get_subscription_count)
    publisher.publish(_message(2))
    _spin(node, lambda: received)
    publisher.publish(received[0])
    publisher.publish(serialize_message(received[0]))
    _spin(node, lambda: len(received) == 3)
    assert received == [_message(2)] * 3


class _Recorder:
    """Records the Python functions that are entered, as (file, name)."""

    def __init__(self) -> None:
        self.entered: list[tuple[str, str]] = []

    def __enter__(self) -> list[tuple[str, str]]:
        sys.setprofile(self._record)
        return self.entered

    def __exit__(self, *_: object) -> None:
        sys.setprofile(None)

    def _record(self, frame: Any, event: str, _: object) -> None:
        if event == "call":
            self.entered.append((Path(frame.f_code.co_filename).name, frame.f_code.co_name))


def test_nothing_but_the_conversion_runs_bytecode_while_sending(node: Node) -> None:
    """Bytecode under the middleware's locks would deadlock: another thread can get the interpreter's lock there."""
    publisher = node.create_publisher(TFMessage, "/tf", 10)
    message = _message(1)
    publisher.publish(message)
    with _Recorder() as entered:
        publisher.publish(message)
    ours = [
        name for file, name in entered if file in ("conversion.py", "typesupport.py", "wire.py", "tf2.py")
    ]
    assert ours[0] == "_from_py"
    after = entered[max(index for index, (_, name) in enumerate(entered) if name == "body") + 1 :]
    assert {file for file, _ in after} <= {
        "layouts.py",
        "__init__.py",
        "publisher.py",
        "test_type_support.py",
    }
    assert [name for file, name in after if file == "__init__.py"] == ["cast"]


def test_nothing_runs_bytecode_while_receiving() -> None:
    sent = serialize_message(_message(1))
    with _Recorder() as entered:
        deserialize_message(sent, TFMessage)
    files = [file for file, _ in entered]
    assert files[0] == "serialization.py"
    assert entered[files.index("tf2.py")] == ("tf2.py", "__call__")
    assert set(files[: files.index("tf2.py")]) == {"serialization.py", "type_support.py"}


_MALFORMED = (b"\0\1\0\0", b"\0\1\0\0\xff\xff\xff\xff", b"\0\1\0\0\1\0\0\0abc")


@pytest.mark.parametrize("content", _MALFORMED)
def test_malformed_bytes_are_told_and_taken_as_nothing(
    content: bytes, caplog: pytest.LogCaptureFixture
) -> None:
    assert deserialize_message(content, TFMessage) == TFMessage()
    (record,) = caplog.records
    assert record.levelname == "ERROR"
    assert record.message.startswith("a malformed TFMessage came in, taken as an empty one: a ")


def test_a_subscription_survives_malformed_messages(node: Node) -> None:
    received: list[TFMessage] = []
    node.create_subscription(TFMessage, "/tf", received.append, 10)
    publisher = node.create_publisher(TFMessage, "/tf", 10)
    _spin(node, publisher.get_subscription_count)
    for content in _MALFORMED:
        publisher.publish(content)
    publisher.publish(_message(1))
    _spin(node, lambda: _message(1) in received)
    assert received == [TFMessage(), TFMessage(), TFMessage(), _message(1)]


def test_bytes_in_no_known_encoding_are_refused_by_the_middleware() -> None:
    with pytest.raises(Exception, match="Fast CDR exception deserializing message of type tf2_msgs"):
        deserialize_message(b"\0", TFMessage)


@pytest.mark.parametrize(
    "transforms",
    [None, 5, [None], [TransformStamped(child_frame_id=5)], [TransformStamped(child_frame_id="\ud800")]],
    ids=["no list", "a number", "no transform", "no text", "no UTF-8"],
)
def test_what_cannot_be_sent_raises_and_says_why(
    transforms: object, caplog: pytest.LogCaptureFixture
) -> None:
    with pytest.raises(RuntimeError):
        serialize_message(TFMessage(transforms=transforms))
    (record,) = caplog.records
    assert record.message == "this TFMessage cannot be sent"
    assert record.exc_info is not None
    assert serialize_message(TFMessage()) == b"\0\1\0\0\0\0\0\0"


class _Interrupting(list[TransformStamped]):
    """Transforms during whose conversion Ctrl-C is pressed, the first time."""

    pressed = False

    def __iter__(self) -> Iterator[TransformStamped]:
        if not self.pressed:
            self.pressed = True
            signal.raise_signal(signal.SIGINT)
        return super().__iter__()


def test_an_interrupt_during_a_conversion_is_neither_lost_nor_in_the_way() -> None:
    sent = []

    def send() -> None:
        sent.append(serialize_message(TFMessage(transforms=_Interrupting(_message(2).transforms))))
        time.sleep(30.0)  # which begins without a look at what came just before it

    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        send()
    assert time.monotonic() - began < 20.0
    assert sent == [serialize_message(_message(2))]


def test_messages_in_transit_do_not_pile_up() -> None:
    sent = serialize_message(_message(100))
    for _ in range(20):
        deserialize_message(sent, TFMessage)
    before = _resident_kilobytes()
    for _ in range(300):  # 300 messages of 8 kB each way
        serialize_message(deserialize_message(sent, TFMessage))
    assert _resident_kilobytes() - before < 1500


@pytest.mark.long
def test_a_hundred_thousand_messages_leave_no_memory_behind(node: Node) -> None:
    received: list[int] = []
    node.create_subscription(TFMessage, "/tf", lambda message: received.append(len(message.transforms)), 10)
    publisher = node.create_publisher(TFMessage, "/tf", 10)
    _spin(node, publisher.get_subscription_count)
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    message = _message(3)
    before = 0
    for number in range(100_000):
        publisher.publish(message)
        if number % 10 == 0:
            executor.spin_once(timeout_sec=0)
        if number == 5000:
            before = _resident_kilobytes()
    executor.shutdown()
    assert _resident_kilobytes() - before < 2000
    assert set(received) == {3}


def _resident_kilobytes() -> int:
    status = Path("/proc/self/status").read_text()
    return int(status.partition("VmRSS:")[2].split()[0])


def test_a_missing_library_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(typesupport, "_FAST_CDR", "libfastcdr.so.99")
    element = conversion.address_in(type(TransformStamped)._TYPE_SUPPORT)
    with pytest.raises(
        typesupport.UnsupportedInstallationError, match=r"libfastcdr\.so\.99.*install tf2_msgs"
    ):
        typesupport.build(element, conversion.MessageInTransit)


def test_a_foreign_layout_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(layouts.FastBuffer, "bytes", property(lambda _: layouts.Bytes(1, 2)))
    element = conversion.address_in(type(TransformStamped)._TYPE_SUPPORT)
    with pytest.raises(typesupport.UnsupportedInstallationError, match="install tf2_msgs"):
        typesupport.build(element, conversion.MessageInTransit)
