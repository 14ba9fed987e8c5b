"""Components to load, and a client that asks containers: components.py

The client reads lines of JSON. `{"call": SERVICE, "type": "package/srv/Name", "fields": {...}}` is answered with the
fields of the response, `{"graph": [NODE, ...]}` with all that is in the graph but for those nodes and the client.
`{"begin": ...}` is a call that is answered at once, `{"end": SERVICE}` with its response; `{"meet": SERVICE}` only makes
the client that later calls use, `{"drop": SERVICE}` forgets it. An answer is `{"answer": ...}`, or `{"failure": "why"}`.
"""

import json
import os
import sys
import threading
import time
from importlib import import_module
from typing import Any

import rclpy
from rclpy.action import ActionClient, ActionServer
from rclpy.lifecycle import LifecycleNode
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger

from orchestra.ros.interfaces.definitions import provide

provide("tf2_msgs")  # no wheel has it
provide("composition_interfaces")
from tf2_msgs.action import LookupTransform  # noqa: E402 - as above

MET = threading.Event()
# Generous: it only ends what would otherwise hang. Two of them are less than a test may take.
PATIENCE = 50.0


def write(line: str) -> None:
    os.write(1, f"{line}\n".encode())


class Plain(Node):
    """Takes nothing, as most classes of nodes do."""

    def __init__(self) -> None:
        super().__init__("plain")
        self.chatter = self.create_publisher(String, "chatter", 1)
        self.create_service(Trigger, "~/thread", self.tell_thread)
        self.declare_parameters("", list(TYPES.items()))
        self.declare_parameter("unset", "as it is")

    def tell_thread(self, _request: Any, response: Any) -> Any:
        response.message = threading.current_thread().name
        return response


class Keywords(Node):
    """Passes on what it is given, and insists on a name."""

    def __init__(self, node_name: str, **options: Any) -> None:
        super().__init__(node_name, cli_args=["--ros-args", "-r", "chatter:=own"], **options)
        self.create_publisher(String, "chatter", 1)


class Everything(LifecycleNode):
    """Has one of everything in the graph, and another node."""

    def __init__(self) -> None:
        super().__init__("everything")
        self.server = ActionServer(self, LookupTransform, "look", lambda _goal: LookupTransform.Result())
        self.client = ActionClient(self, LookupTransform, "look")
        self.create_lifecycle_publisher(String, "chatter", 1)
        self.create_subscription(String, "chatter", self.hear, 1)
        self.create_client(Trigger, "trigger")
        self.create_timer(0.01, lambda: None)
        self.inner = rclpy.create_node("inner")

    def hear(self, _message: String) -> None:
        """Hear nobody."""


class Unsteady(Everything):
    def on_activate(self, state: Any) -> Any:
        raise ValueError(f"no way from {state.label}")


class Broken(Everything):
    def __init__(self) -> None:
        super().__init__()
        raise ValueError("no such device")


class Quitting(Node):
    def __init__(self) -> None:
        super().__init__("quitting")
        raise SystemExit(3)


class Stubborn(Node):
    """Says good-bye, and forgets all else."""

    def __init__(self) -> None:
        super().__init__("stubborn")
        self.create_publisher(String, "chatter", 1)

    def destroy_node(self) -> None:
        write("good-bye")


class Failing(Node):
    """Fails, or ends the process, when it is told to."""

    def __init__(self) -> None:
        super().__init__("failing")
        self.create_service(Trigger, "~/fail", self.fail)
        self.create_service(Trigger, "~/leave", self.leave)

    def fail(self, _request: Any, _response: Any) -> Any:
        raise RuntimeError("out of order")

    def leave(self, _request: Any, _response: Any) -> Any:
        raise SystemExit(4)


class Waiting(Node):
    """Has a callback that ends when that of another node is called."""

    def __init__(self) -> None:
        super().__init__("waiting")
        self.ended = 0.0
        self.create_service(Trigger, "~/wait", self.wait)

    def wait(self, _request: Any, response: Any) -> Any:
        write("waits")
        response.success = MET.wait(PATIENCE)
        write(f"met: {response.success}")
        self.ended = time.monotonic()
        return response

    def destroy_node(self) -> None:
        write(f"stayed: {time.monotonic() - self.ended:.3f}")
        super().destroy_node()


class Meeting(Node):
    def __init__(self) -> None:
        super().__init__("meeting")
        self.create_service(Trigger, "~/meet", self.meet)

    def meet(self, _request: Any, response: Any) -> Any:
        MET.set()
        response.success = True
        return response


class Demanding(Node):
    def __init__(self, node_name: str, robot: str) -> None:
        super().__init__(f"{node_name}_{robot}")


def made_by_a_function() -> Node:
    return Plain()


def no_node() -> int:
    return 7


TYPES = {
    "flag": False,
    "whole": 0,
    "real": 0.0,
    "text": "",
    "bytes": [b"\0"],
    "flags": [False],
    "wholes": [0],
    "reals": [0.0],
    "texts": [""],
}


class Client:
    def __init__(self) -> None:
        rclpy.init(args=[])
        self.node = rclpy.create_node("asking_client", start_parameter_services=False, enable_rosout=False)
        self.clients: dict[str, Any] = {}
        self.futures: dict[str, Any] = {}

    def call(self, service: str, kind: str, fields: dict[str, Any]) -> dict[str, Any]:
        self.begin(service, kind, fields)
        return self.end(service)

    def begin(self, service: str, kind: str, fields: dict[str, Any]) -> None:
        self.meet(service, kind)
        client = self.clients[service]
        request = client.srv_type.Request()
        for key, value in fields.items():
            setattr(request, key, made(key, value))
        self.futures[service] = client.call_async(request)

    def meet(self, service: str, kind: str) -> None:
        if service in self.clients:
            return
        package, _, name = kind.split("/")
        client = self.node.create_client(getattr(import_module(f"{package}.srv"), name), service)
        there = client.wait_for_service(PATIENCE)
        node = service.partition("/_container/")[0].removesuffix(f"/{service.rpartition('/')[2]}")
        if not there or not self.greeted(node):
            self.node.destroy_client(client)
            raise TimeoutError(f"{node} has not answered within {PATIENCE} s")
        self.clients[service] = client

    def end(self, service: str) -> dict[str, Any]:
        future = self.futures.pop(service)
        rclpy.spin_until_future_complete(self.node, future, timeout_sec=PATIENCE)
        if not future.done():
            self.drop(service)
            raise TimeoutError(f"no answer of {service} within {PATIENCE} s")
        if "/_container/" not in service:
            self.drop(service)
        answer = future.result()
        found = {key: getattr(answer, key) for key in answer.get_fields_and_field_types()}
        return {key: value if isinstance(value, str | int) else plain(value) for key, value in found.items()}

    def drop(self, service: str) -> None:
        self.futures.pop(service, None)
        self.node.destroy_client(self.clients.pop(service))

    def greeted(self, node: str) -> bool:
        """Ask until the node answers: then it has discovered the readers that were made before."""
        kind = import_module("rcl_interfaces.srv").GetParameters
        greeting = self.node.create_client(kind, f"{node}/get_parameters")
        found = False
        deadline = time.monotonic() + PATIENCE
        while not found and time.monotonic() < deadline:
            if greeting.wait_for_service(1):
                future = greeting.call_async(kind.Request())
                rclpy.spin_until_future_complete(self.node, future, timeout_sec=1)
                found = future.done()
        self.node.destroy_client(greeting)
        return found

    def graph(self, but: list[str]) -> list[str]:
        """Return every node, and every end of a topic or service, of others."""
        left_out = {*but, "asking_client"}
        found = []
        for name, namespace in self.node.get_node_names_and_namespaces():
            if name not in left_out:
                found.append(f"node {namespace} {name}")
        for topic, _ in self.node.get_topic_names_and_types():
            for look in (self.node.get_publishers_info_by_topic, self.node.get_subscriptions_info_by_topic):
                found += [
                    f"{topic} {end.endpoint_type.name} {end.node_name}"
                    for end in look(topic)
                    if end.node_name not in left_out
                ]
        names = {name for name, _ in self.node.get_service_names_and_types()} - self.clients.keys()
        found += [
            f"service {name}" for name in names if not any(name.startswith(f"/{one}/") for one in left_out)
        ]
        return sorted(found)


def made(key: str, value: Any) -> Any:
    """Return a field of a request: parameters are given as a mapping from name to type and value."""
    if key == "transition":
        return import_module("lifecycle_msgs.msg").Transition(**value)
    if key not in ("parameters", "extra_arguments"):
        return value
    from rclpy.parameter import Parameter  # noqa: PLC0415 - only the client needs it

    found = []
    for name, (kind, data) in value.items():
        held = [bytes([one]) for one in data] if kind == "BYTE_ARRAY" else data
        found.append(Parameter(name, Parameter.Type[kind], held).to_parameter_msg())
    return found


def plain(value: Any) -> Any:
    """Return a list of plain values; a parameter's value is the one that is set."""
    return [one if isinstance(one, str | int) else held(one) for one in value]


def held(value: Any) -> Any:
    from rclpy.parameter import parameter_value_to_python  # noqa: PLC0415 - only the client needs it

    found = parameter_value_to_python(value)
    if isinstance(found, str | int | float) or found is None:
        return found
    return [one[0] if isinstance(one, bytes) else one for one in found]


def answered(client: Client, order: dict[str, Any]) -> Any:
    match order:
        case {"call": service, "type": kind, "fields": fields}:
            return client.call(service, kind, fields)
        case {"begin": service, "type": kind, "fields": fields}:
            return client.begin(service, kind, fields)
        case {"meet": service, "type": kind}:
            return client.meet(service, kind)
        case {"end": service}:
            return client.end(service)
        case {"drop": service}:
            return client.drop(service)
    rclpy.spin_once(client.node, timeout_sec=0)
    found = client.graph(order["graph"])
    time.sleep(0.02)
    return found


def main() -> None:
    client = Client()
    write(json.dumps("ready"))
    for line in sys.stdin:
        try:
            found = {"answer": answered(client, json.loads(line))}
        except Exception as error:  # noqa: BLE001 - it is the test that fails
            found = {"failure": f"{type(error).__name__}: {error}"}
        write(json.dumps(found))


if __name__ == "__main__":
    main()
