"""Publishes on topics once it is told to by a line on standard input, or at once.

publisher.py [wait] TOPIC,RELIABILITY,DURABILITY,COUNT ...   ten times a second; COUNT 0 is for ever, - never
"""

import itertools
import signal
import sys

import rclpy
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import String


def publish_on(node: Node, publisher: Publisher, count: int | None) -> None:
    """Publish so many times, None for ever."""
    rest = itertools.repeat(String(data="again")) if count is None else iter([String(data="again")] * count)

    def tick() -> None:
        message = next(rest, None)
        if message:
            publisher.publish(message)

    node.create_timer(0.1, tick)


def main() -> None:
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    signal.signal(signal.SIGINT, lambda *_: sys.exit(0))
    rclpy.init(signal_handler_options=rclpy.signals.SignalHandlerOptions.NO)
    node = rclpy.create_node("publisher")
    words = sys.argv[1:]
    try:
        for word in words:
            topic, reliability, durability, count = word.split(",")
            profile = QoSProfile(
                depth=1,
                reliability=ReliabilityPolicy[reliability],
                durability=DurabilityPolicy[durability],
            )
            publisher = node.create_publisher(String, topic, profile)
            if count == "1":
                publisher.publish(String(data="once"))
            elif count != "-":
                publish_on(node, publisher, int(count) or None)
        sys.stdout.write("up\n")
        sys.stdout.flush()
        rclpy.spin(node)
    finally:
        node.destroy_node()
        rclpy.shutdown()


main()
