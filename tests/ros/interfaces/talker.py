"""Publish one TFMessage that stays for who comes later, say so, and leave when standard input ends."""

from __future__ import annotations

import sys

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.qos import DurabilityPolicy, QoSProfile

from orchestra.ros.interfaces import tf_message_type


def main() -> None:
    message_class = tf_message_type()
    rclpy.init()
    node = rclpy.create_node("talker")
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    publisher = node.create_publisher(message_class, "/tf_static", latched)
    transform = TransformStamped(child_frame_id="robot1/laser")
    transform.header.frame_id = "robot1/base_link"
    transform.transform.translation.x = 0.25
    publisher.publish(message_class(transforms=[transform] * 3))
    print("published", flush=True)  # noqa: T201  # the test reads it
    sys.stdin.read()
    rclpy.shutdown()


if __name__ == "__main__":
    main()
