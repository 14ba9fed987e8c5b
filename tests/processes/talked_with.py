"""Nodes for the ROS command line to look at and talk with, all in one process; it says `ready` when they are there.

/robot1/actor     parameters of every type, a service, a client, topics with several QoS, transforms
/robot1/_hidden   a hidden node with a hidden topic
/robot1/machine   a lifecycle node that cannot be activated
"""

import math
import sys

import rclpy
from geometry_msgs.msg import TransformStamped
from rcl_interfaces.msg import IntegerRange, ParameterDescriptor
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.lifecycle import LifecycleNode, State, TransitionCallbackReturn
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Int32, String
from std_srvs.srv import SetBool, Trigger

from orchestra.ros.interfaces import tf_message_type

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
RAYS = 360


class Actor(Node):
    def __init__(self) -> None:
        super().__init__("actor", namespace="/robot1")
        self.declare()
        self.count = 0
        self.heard = self.create_publisher(String, "heard", LATCHED)
        self.create_publisher(String, "map", LATCHED).publish(String(data="a map"))
        self.chatter = self.create_publisher(String, "chatter", 10)
        self.scan = self.create_publisher(
            LaserScan, "scan", QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
        )
        self.rays = LaserScan(ranges=[0.5 * ray for ray in range(RAYS)])
        self.create_subscription(Int32, "numbers", self.hear, 10)
        self.create_service(SetBool, "switch", self.switch)
        self.create_client(Trigger, "trigger")
        kind = tf_message_type()
        self.moving = self.create_publisher(kind, "/tf", 10)
        self.fixed = self.create_publisher(kind, "/tf_static", LATCHED)
        self.fixed.publish(kind(transforms=[self.transform("base", "laser", 0.2, 0.0)]))
        self.kind = kind
        self.create_timer(0.01, self.tick)

    def declare(self) -> None:
        described = ParameterDescriptor(
            description="How many", integer_range=[IntegerRange(from_value=1, to_value=9, step=2)]
        )
        self.declare_parameter("count", 3, described)
        self.declare_parameter("fixed", "x", ParameterDescriptor(read_only=True))
        self.declare_parameter("flag", True)
        self.declare_parameter("speed", 1.5)
        self.declare_parameter("word", "hello: 'you'")
        self.declare_parameter("data", [b"\x01", b"\xff"])
        self.declare_parameter("flags", [True, False])
        self.declare_parameter("counts", [1, 2])
        self.declare_parameter("speeds", [0.5, 1.0])
        self.declare_parameter("words", ["a", "1"])
        self.declare_parameter("limits.max", 2.0)
        self.declare_parameter("loose", 1, ParameterDescriptor(dynamic_typing=True))

    def hear(self, message: Int32) -> None:
        self.heard.publish(String(data=f"heard {message.data}"))

    def switch(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        response.success, response.message = request.data, "it is so"
        return response

    def tick(self) -> None:
        self.count += 1
        self.rays.header.stamp = self.get_clock().now().to_msg()
        self.scan.publish(self.rays)
        if self.count % 5 == 0:
            self.chatter.publish(String(data=f"Hello: {self.count}"))
            self.moving.publish(self.kind(transforms=[self.transform("odom", "base", 1.0, math.pi / 2)]))

    def transform(self, parent: str, child: str, x: float, yaw: float) -> TransformStamped:
        made = TransformStamped(child_frame_id=child)
        made.header.frame_id = parent
        made.header.stamp = self.get_clock().now().to_msg()
        made.transform.translation.x = x
        made.transform.rotation.z, made.transform.rotation.w = math.sin(yaw / 2), math.cos(yaw / 2)
        return made


class Machine(LifecycleNode):
    def on_configure(self, _state: State) -> TransitionCallbackReturn:
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, _state: State) -> TransitionCallbackReturn:
        return TransitionCallbackReturn.FAILURE


def main() -> None:
    rclpy.init()
    hidden = Node("_hidden", namespace="/robot1")
    hidden.create_publisher(String, "_secret", 10)
    executor = SingleThreadedExecutor()
    for node in (Actor(), hidden, Machine("machine", namespace="/robot1")):
        executor.add_node(node)
    sys.stdout.write("ready\n")
    sys.stdout.flush()
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        return


if __name__ == "__main__":
    main()
