"""Wait for one TFMessage on /tf_static; print what came and what the graph tells of the publisher."""

from __future__ import annotations

import json

import rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile

from orchestra.ros.interfaces import message_type


def main() -> None:
    rclpy.init()
    node = rclpy.create_node("listener")
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    received: list[object] = []
    node.create_subscription(message_type("tf2_msgs/msg/TFMessage"), "/tf_static", received.append, latched)
    while not received:
        rclpy.spin_once(node, timeout_sec=0.5)
    (publisher,) = node.get_publishers_info_by_topic("/tf_static")
    heard = {
        "message": repr(received[0]),
        "type": publisher.topic_type,
        "hash": str(publisher.topic_type_hash),
    }
    print(json.dumps(heard))  # noqa: T201  # the test reads it
    rclpy.shutdown()


if __name__ == "__main__":
    main()
