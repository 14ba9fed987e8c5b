"""A graph in which much is wrong, all in one process; it says `ready` when it is there.

Each fault is at names of its own, so that a test can look for its own alone.
"""

import sys
import time

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.time import Time
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Int32, String

from orchestra.ros.interfaces import tf_message_type

BEST_EFFORT = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
JUMP_EVERY = 50  # ticks of 10 ms


class Ailing(Node):
    """Publishes a clock that is set back again and again, and transforms with all their faults."""

    def __init__(self) -> None:
        super().__init__("sim", namespace="/ill")
        self.clock = self.create_publisher(Clock, "/clock", BEST_EFFORT)
        kind = tf_message_type()
        self.kind = kind
        self.moving = self.create_publisher(kind, "/tf", 100)
        self.fixed = self.create_publisher(kind, "/tf_static", LATCHED)
        self.fixed.publish(
            kind(transforms=[self.transform("base", "laser", 0.0), self.transform("island", "hut", 0.0)])
        )
        self.count = 0
        self.create_timer(0.01, self.tick)

    def transform(self, parent: str, child: str, stamp: float) -> TransformStamped:
        made = TransformStamped(child_frame_id=child)
        made.header.frame_id = parent
        made.header.stamp = Time(nanoseconds=int(stamp * 1e9)).to_msg()
        return made

    def tick(self) -> None:
        self.count += 1
        simulated = 100.0 + (self.count % JUMP_EVERY) * 0.01
        self.clock.publish(Clock(clock=Time(nanoseconds=int(simulated * 1e9)).to_msg()))
        now = time.time()
        sent = [self.transform("odom", "base", now), self.transform("base", "arm", now - 2.0)]
        if self.count % 2:
            sent.append(self.transform("odom", "wheel", now))
        else:
            sent.append(self.transform("base", "wheel", now))
        if self.count % 100 == 1:
            sent.append(self.transform("base", "slow", now))
        self.moving.publish(self.kind(transforms=sent))


def ends() -> list[Node]:
    """Nodes that do not meet."""
    driver, mapper = Node("driver", namespace="/ill"), Node("mapper", namespace="/ill")
    driver.create_publisher(String, "scan", BEST_EFFORT)
    mapper.create_subscription(String, "scan", print, 10)
    driver.create_publisher(String, "map", 10)
    mapper.create_subscription(String, "map", print, LATCHED)
    driver.create_publisher(Int32, "mixed", 10)
    driver.create_publisher(Int32, "velocity", 10)
    mapper.create_subscription(Int32, "velocty", print, 10)
    driver.create_publisher(Int32, "left/image", 10)
    mapper.create_subscription(Int32, "right/image", print, 10)
    twins = [Node("twin", namespace="/ill") for _ in range(2)]
    simulated = Node("planner", namespace="/ill", parameter_overrides=[Parameter("use_sim_time", value=True)])
    return [driver, mapper, *twins, simulated]


def main() -> None:
    rclpy.init()
    apart = rclpy.Context()  # the middleware has one type for a name in each participant
    rclpy.init(context=apart)
    other = Node("other", namespace="/ill", context=apart, start_parameter_services=False)
    other.create_subscription(String, "mixed", print, 10)
    executor = SingleThreadedExecutor()
    nodes = [Ailing(), *ends()]
    hung = Node("hung", namespace="/ill")  # in no executor: nobody answers for it
    for node in nodes:
        executor.add_node(node)
    sys.stdout.write("ready\n")
    sys.stdout.flush()
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        hung.destroy_node()
        other.destroy_node()


if __name__ == "__main__":
    main()
