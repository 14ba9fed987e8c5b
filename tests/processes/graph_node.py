"""A node that does with its graph what lines on standard input say, and repeats each when it is done.

graph_node.py FULL_NAME

topic NAME              publish on it, ten times a second
service NAME            offer it
action NAME             offer an action: its three services and two topics
set NAME VALUE          declare a parameter, or change it; VALUE is JSON
tf PARENT CHILD         publish this transform on /tf, ten times a second
tf_static PARENT CHILD  publish it on /tf_static, once
"""

import json
import signal
import sys
import threading
from queue import SimpleQueue

import rclpy
from geometry_msgs.msg import TransformStamped
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.signals import SignalHandlerOptions
from std_msgs.msg import String
from std_srvs.srv import Trigger

from orchestra.ros.interfaces import tf_message_type

LATCHED = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class GraphNode(Node):
    def topic(self, name: str) -> None:
        publisher = self.create_publisher(String, name, 10)
        self.create_timer(0.1, lambda: publisher.publish(String(data="again")))

    def service(self, name: str) -> None:
        self.create_service(Trigger, name, lambda _request, response: response)

    def action(self, name: str) -> None:
        for part in ("send_goal", "cancel_goal", "get_result"):
            self.service(f"{name}/_action/{part}")
        for part in ("feedback", "status"):
            self.create_publisher(String, f"{name}/_action/{part}", 10)

    def set(self, name: str, value: str) -> None:
        if not self.has_parameter(name):
            self.declare_parameter(name, json.loads(value), ParameterDescriptor(dynamic_typing=True))
        self.set_parameters([Parameter(name, value=json.loads(value))])

    def tf(self, parent: str, child: str) -> None:
        publisher = self.create_publisher(tf_message_type(), "/tf", 10)
        self.create_timer(0.1, lambda: publisher.publish(transform(parent, child)))

    def tf_static(self, parent: str, child: str) -> None:
        self.create_publisher(tf_message_type(), "/tf_static", LATCHED).publish(transform(parent, child))


def transform(parent: str, child: str) -> object:
    stamped = TransformStamped(child_frame_id=child)
    stamped.header.frame_id = parent
    return tf_message_type()(transforms=[stamped])


def write(text: str) -> None:
    sys.stdout.write(text)
    sys.stdout.flush()


def read(lines: SimpleQueue[str]) -> None:
    for line in sys.stdin:
        lines.put(line)


def main() -> None:
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    namespace, _, name = sys.argv[1].rpartition("/")
    node = GraphNode(name, namespace=namespace)
    lines: SimpleQueue[str] = SimpleQueue()
    threading.Thread(target=read, args=(lines,), daemon=True).start()
    write("up\n")
    try:
        while True:
            while not lines.empty():
                line = lines.get()
                word, *arguments = line.split()
                getattr(node, word)(*arguments)
                write(line)
            rclpy.spin_once(node, timeout_sec=0.05)
    finally:
        node.destroy_node()
        rclpy.shutdown()


main()
