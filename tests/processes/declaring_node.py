"""A node that declares parameters of every type and has interfaces of every kind; it says `ready` when all is there.

declaring_node.py FULL_NAME
"""

import signal
import sys

import rclpy
from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions
from std_msgs.msg import Int32, String
from std_srvs.srv import SetBool, Trigger

_LATCHED = QoSProfile(depth=5, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_STRICT = QoSProfile(
    depth=1,
    reliability=ReliabilityPolicy.BEST_EFFORT,
    deadline=Duration(seconds=0.5),
    liveliness=LivelinessPolicy.MANUAL_BY_TOPIC,
    liveliness_lease_duration=Duration(seconds=2),
)


def declare(node: Node) -> None:
    node.declare_parameter("flag", True, ParameterDescriptor(description="A boolean"))
    node.declare_parameter("speed", 1.5, _floating(0.0, 5.0, 0.0))
    node.declare_parameter("level", 0.25, _floating(0.0, 1.0, 0.25))
    node.declare_parameter("count", 3, _integer(1, 9, 2))
    node.declare_parameter("rest", 4, _integer(0, 8, 4))
    node.declare_parameter(
        "name", "x", ParameterDescriptor(read_only=True, additional_constraints="one letter")
    )
    node.declare_parameter("data", [b"\x01", b"\xff"])
    node.declare_parameter("flags", [True, False])
    node.declare_parameter("counts", [1, 2])
    node.declare_parameter("speeds", [0.5, 1.0])
    node.declare_parameter("names", ["a", "b"])
    node.declare_parameter("limits.max", 2.0)
    node.declare_parameter("limits.min", -2.0)
    node.declare_parameter("any", None, ParameterDescriptor(dynamic_typing=True))
    node.declare_parameter("later", Parameter.Type.DOUBLE_ARRAY)
    node.declare_parameter("endless", float("inf"))


def _floating(low: float, high: float, step: float) -> ParameterDescriptor:
    return ParameterDescriptor(
        floating_point_range=[FloatingPointRange(from_value=low, to_value=high, step=step)]
    )


def _integer(low: int, high: int, step: int) -> ParameterDescriptor:
    return ParameterDescriptor(integer_range=[IntegerRange(from_value=low, to_value=high, step=step)])


def connect(node: Node) -> None:
    node.create_publisher(String, "chatter", _LATCHED)
    node.create_publisher(Int32, "/everywhere", 10)
    node.create_subscription(Int32, "~/numbers", lambda _: None, _STRICT)
    node.create_service(Trigger, "~/go", lambda _request, response: response)
    node.create_client(SetBool, "switch")


def main() -> None:
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    space, _, name = sys.argv[1].rpartition("/")
    node = Node(name, namespace=space)
    declare(node)
    connect(node)
    signal.signal(signal.SIGINT, lambda *_: sys.exit(0))
    sys.stdout.write("ready\n")
    sys.stdout.flush()
    rclpy.spin(node)


if __name__ == "__main__":
    main()
