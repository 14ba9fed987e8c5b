"""Two threads publish while three take, and threads change as often as they can."""

from __future__ import annotations

import sys
import threading

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor

from orchestra.ros.interfaces import tf_message_type


def main() -> None:
    message_class = tf_message_type()
    message = message_class(
        transforms=[TransformStamped(child_frame_id=f"frame{index}") for index in range(3)]
    )
    rclpy.init()
    node = rclpy.create_node("crowd")
    publisher = node.create_publisher(message_class, "/tf", 100)
    received: list[object] = []
    node.create_subscription(
        message_class, "/tf", received.append, 100, callback_group=ReentrantCallbackGroup()
    )
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(node)
    sys.setswitchinterval(1e-6)

    def publish() -> None:
        for _ in range(2000):
            publisher.publish(message)

    senders = [threading.Thread(target=publish) for _ in range(2)]
    for sender in senders:
        sender.start()
    while any(sender.is_alive() for sender in senders):
        executor.spin_once(timeout_sec=0.05)
    while not received:
        executor.spin_once(timeout_sec=0.05)
    assert all(found == message for found in received)
    print("done")  # noqa: T201  # the test reads it
    # rclpy's shutdown destroys what a handler that is just ending still touches: let the threads end first.
    executor._executor.shutdown()
    executor.shutdown()
    rclpy.shutdown()


if __name__ == "__main__":
    main()
