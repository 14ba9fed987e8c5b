"""A component container: container.py FULL_NAME [WORD ...]

refuse=PLUGIN     this plug-in cannot be loaded
die=PLUGIN        ... ends the process with 9
hang=PLUGIN       ... never answers
bare              without parameter services
silent            no container at all, only a process that runs

A plug-in `Managed` is a lifecycle node, every other one a plain node. Each request is written as one line of JSON.
"""

import json
import os
import signal
import sys
from typing import Any

import rclpy
from rcl_interfaces.msg import Parameter as ParameterMessage
from rclpy.lifecycle import LifecycleNode
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.signals import SignalHandlerOptions

from orchestra.ros.interfaces import load_node_type


class Container:
    def __init__(self, full_name: str, words: list[str]) -> None:
        namespace, _, name = full_name.rpartition("/")
        pairs = (word.partition("=") for word in words)
        self.manners = {plugin: manner for manner, _, plugin in pairs}
        self.node = Node(name, namespace=namespace, start_parameter_services="bare" not in words)
        self.executor = rclpy.executors.SingleThreadedExecutor()
        self.executor.add_node(self.node)
        self.count = 0
        self.nodes: list[Node] = []
        self.node.create_service(load_node_type(), f"{full_name}/_container/load_node", self.load)

    def load(self, request: Any, response: Any) -> Any:
        os.write(1, f"{json.dumps(plain(request))}\n".encode())
        match self.manners.get(request.plugin_name):
            case "refuse":
                response.error_message = f"no class {request.plugin_name}"
                return response
            case "die":
                os._exit(9)
            case "hang":
                signal.pause()
        kind = LifecycleNode if request.plugin_name == "Managed" else Node
        node = kind(request.node_name or request.plugin_name.lower(), namespace=request.node_namespace or "/")
        self.nodes.append(node)
        self.executor.add_node(node)
        self.count += 1
        response.success = True
        response.full_node_name = node.get_fully_qualified_name()
        response.unique_id = self.count
        return response


def plain(request: Any) -> dict[str, Any]:
    found = {name: getattr(request, name) for name in request.get_fields_and_field_types()}
    for name in ("parameters", "extra_arguments"):
        found[name] = {item.name: value_of(item) for item in found[name]}
    return found


def value_of(item: ParameterMessage) -> Any:
    value = Parameter.from_parameter_msg(item).value
    return value if isinstance(value, str | int | float) else list(value)


def main() -> None:
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    full_name, *words = sys.argv[1:]
    if words == ["silent"]:
        signal.pause()
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
    container = Container(full_name, words)
    container.executor.spin()


main()
