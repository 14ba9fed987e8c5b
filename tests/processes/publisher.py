"""Publishes on topics.

publisher.py TOPIC,RELIABILITY,DURABILITY,COUNT ...   ten times a second; COUNT 0 is for ever, - never; 1 is at once, more are
                                                      counted from the first subscription
"""

import itertools
import signal
import sys
import threading

import rclpy
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import String


def publish_on(node: Node, publisher: Publisher, count: int | None) -> None:
    """Publish so many times, None for ever."""
    rest = itertools.repeat(String(data="again")) if count is None else iter([String(data="again")] * count)
    begun = count is None

    def tick() -> None:
        nonlocal begun
        begun = begun or bool(publisher.get_subscription_count())
        message = next(rest, None) if begun else None
        if message:
            publisher.publish(message)

    node.create_timer(0.1, tick)


def main() -> None:
    # No exception from a handler: one that is raised within a callback of the middleware is lost.
    over = threading.Event()
    signal.signal(signal.SIGTERM, lambda *_: over.set())
    signal.signal(signal.SIGINT, lambda *_: over.set())
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
        while not over.is_set():
            rclpy.spin_once(node, timeout_sec=0.1)
    finally:
        node.destroy_node()
        rclpy.shutdown()


main()
