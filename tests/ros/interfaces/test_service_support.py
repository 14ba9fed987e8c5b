"""Services without a compiler: against those of the wheels, which were compiled."""

from __future__ import annotations

import ctypes
import importlib
import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
import rclpy
from hypothesis import given
from hypothesis import strategies as st
from rcl_interfaces.msg import Parameter as ParameterMessage
from rcl_interfaces.msg import ParameterValue, SetParametersResult
from rcl_interfaces.srv import SetParametersAtomically
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.serialization import deserialize_message, serialize_message
from rclpy.service_introspection import ServiceIntrospectionState

from orchestra.ros.interfaces import cdr, conversion, layouts, load_node_type
from orchestra.ros.interfaces.definitions import install
from orchestra.ros.interfaces.made.classes import classes_of
from orchestra.ros.interfaces.reading import interface
from orchestra.ros.interfaces.wire import MalformedMessageError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from rclpy.node import Node

_DOMAIN = 36


_FILE = Path(sys.prefix, "share", "rcl_interfaces", "srv", "SetParametersAtomically.srv")
_CLASSES = classes_of(interface.read("rcl_interfaces", _FILE), "rcl_interfaces.srv._clone")

# The same service as the compiled one, made here.
Clone = _CLASSES["SetParametersAtomically"]


@pytest.fixture
def node(monkeypatch: pytest.MonkeyPatch) -> Iterator[Node]:
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    context = rclpy.Context()
    rclpy.init(context=context, domain_id=_DOMAIN)
    node = rclpy.create_node("service_test", context=context)
    yield node
    node.destroy_node()
    rclpy.shutdown(context=context)


def spin(node: Node, until: Callable[[], object]) -> None:
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    for _ in range(300):
        if until():
            break
        executor.spin_once(timeout_sec=0.1)
    executor.shutdown()
    assert until()


def hash_of(service: Any) -> bytes:
    handle = layouts.ServiceHandle.from_address(conversion.address_in(type(service)._TYPE_SUPPORT))
    function = ctypes.PYFUNCTYPE(ctypes.c_void_p, ctypes.c_void_p)(handle.get_type_hash_func)
    return ctypes.string_at(function(ctypes.addressof(handle)), 33)


def test_the_hash_is_that_of_the_compiled_service() -> None:
    for service in (Clone, SetParametersAtomically):
        if type(service)._TYPE_SUPPORT is None:
            type(service).__import_type_support__()
    assert hash_of(Clone) == hash_of(SetParametersAtomically)


VALUES = [
    True,
    7,
    1.5,
    "é",
    [b"\1", b"\2"],
    [True, False, True],
    [1, -(2**62)],
    [0.5, math.inf],
    ["", "abc", "é"],
]


@pytest.mark.parametrize(
    ("serving", "asking"), [(Clone, SetParametersAtomically), (SetParametersAtomically, Clone)]
)
def test_it_talks_to_the_compiled_service_either_way(node: Node, serving: Any, asking: Any) -> None:
    received: list[Any] = []

    def serve(request: Any, response: Any) -> Any:
        received.extend(request.parameters)
        response.result = SetParametersResult(successful=True, reason="why nöt")
        return response

    node.create_service(serving, "/x", serve)
    client = node.create_client(asking, "/x")
    sent = [Parameter(f"p{number}", value=value).to_parameter_msg() for number, value in enumerate(VALUES)]
    spin(node, client.service_is_ready)
    future = client.call_async(asking.Request(parameters=sent))
    spin(node, future.done)
    assert future.result().result == SetParametersResult(successful=True, reason="why nöt")
    assert received == sent


def test_the_events_of_a_service_are_told_where_introspection_is_on(node: Node, tmp_path: Path) -> None:
    (tmp_path / "srv").mkdir()
    (tmp_path / "srv" / "Ask.srv").write_text("rcl_interfaces/Parameter[] asked\n---\nbool ok\n")
    install("introspected_interfaces", tmp_path)
    ask = importlib.import_module("introspected_interfaces.srv").Ask
    heard: list[Any] = []
    kept = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    node.create_subscription(ask.Event, "/x/_service_event", heard.append, kept)

    def serve(_: Any, response: Any) -> Any:
        response.ok = True
        return response

    service = node.create_service(ask, "/x", serve)
    client = node.create_client(ask, "/x")
    for end in (service, client):
        end.configure_introspection(node.get_clock(), kept, ServiceIntrospectionState.CONTENTS)
    sent = [Parameter("p", value="é").to_parameter_msg()]
    spin(node, client.service_is_ready)
    spin(node, client.call_async(ask.Request(asked=sent)).done)
    spin(node, lambda: len(heard) == 4)
    assert sorted(event.info.event_type for event in heard) == [0, 1, 2, 3]
    assert [event.request[0].asked for event in heard if event.request] == [sent, sent]
    assert [event.response[0].ok for event in heard if event.response] == [True, True]
    assert len({event.info.sequence_number for event in heard}) == 1


def test_load_node_has_the_name_and_fields_of_the_package() -> None:
    kind = load_node_type()
    assert kind.__module__.startswith("composition_interfaces.srv")
    assert kind.Response(success=True, unique_id=2**63).unique_id == 2**63
    with pytest.raises(AssertionError, match="Invalid arguments passed to constructor: nonsense"):
        kind.Request(nonsense=1, check_fields=True)
    assert kind.Request(node_name="a") == kind.Request(node_name="a") != kind.Request(node_name="b")


parameter_values = st.one_of(
    st.booleans(),
    st.integers(-(2**63), 2**63 - 1),
    st.floats(allow_nan=False),
    st.text(st.characters(exclude_characters="\0", exclude_categories=["Cs"])),
    st.lists(st.integers(-(2**63), 2**63 - 1), min_size=1),
    st.lists(st.floats(allow_nan=False), min_size=1),
    st.lists(st.text(st.characters(exclude_characters="\0", exclude_categories=["Cs"])), min_size=1),
)


@given(st.text(st.characters(exclude_characters="\0", exclude_categories=["Cs"])), parameter_values)
def test_the_compiled_serializer_reads_our_bytes_and_we_read_its(name: str, value: Any) -> None:
    message = Parameter(name, value=value).to_parameter_msg()
    # The bytes themselves may differ: the compiled one leaves its padding as it finds it.
    assert deserialize_message(cdr.encode(message), ParameterMessage) == message
    assert cdr.decode(serialize_message(message), ParameterMessage) == message


@given(st.binary(max_size=80))
def test_other_bytes_are_refused_or_read_but_never_fail_otherwise(data: bytes) -> None:
    try:
        cdr.decode(b"\0\1\0\0" + data, ParameterValue)
    except MalformedMessageError:
        return
    assert len(data) > 0


def test_a_type_that_cannot_be_sent_raises_and_says_why(caplog: pytest.LogCaptureFixture) -> None:
    type(Clone.Request).__import_type_support__()
    with pytest.raises(RuntimeError):
        serialize_message(Clone.Request(parameters=[5]))
    assert caplog.records[0].message == "this SetParametersAtomically_Request cannot be sent"
