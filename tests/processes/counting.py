"""Publishes or hears numbered messages, for recorders and players to be held to.

counting.py publish COUNT [SIZE]
                            waits on each of its topics for a subscription, publishes COUNT messages on each, says `done`
                            (those on /late have so many bytes)
                            and stays until its standard input ends; the topic /late is made after the others
counting.py hear COUNT      says `ready`, hears COUNT messages on /fast and /late, and says in JSON what came, in order
"""

import json
import sys
import time

import rclpy
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import Header, Int32, String

DEEP = QoSProfile(depth=1000)
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
BEST_EFFORT = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
PAUSE = 0.4


def say(word: str) -> None:
    sys.stdout.write(f"{word}\n")
    sys.stdout.flush()


def matched(publisher: Publisher) -> Publisher:
    while not publisher.get_subscription_count():
        time.sleep(0.01)
    return publisher


def publish(node: Node, count: int, size: int = 0) -> None:
    latched = node.create_publisher(String, "latched", LATCHED)
    latched.publish(String(data="kept"))
    node.create_publisher(String, "_hidden", 10)
    lossy = node.create_publisher(Int32, "lossy", BEST_EFFORT)
    fast = matched(node.create_publisher(Int32, "fast", DEEP))
    late = matched(node.create_publisher(Header, "late", DEEP))
    matched(lossy)
    matched(latched)
    for number in range(count):
        if number == count // 2:
            time.sleep(PAUSE)
        fast.publish(Int32(data=number))
        late.publish(Header(frame_id=str(number).ljust(size)))
        lossy.publish(Int32(data=number))
        time.sleep(0.001)
    for publisher in (fast, late):
        publisher.wait_for_all_acked(Duration(seconds=60))
    say("done")
    sys.stdin.read()


def hear(node: Node, count: int) -> None:
    heard: list[tuple[str, int, int]] = []
    node.create_subscription(
        Int32, "fast", lambda one, about: heard.append(("fast", one.data, about["source_timestamp"])), DEEP
    )
    node.create_subscription(
        Header,
        "late",
        lambda one, about: heard.append(("late", int(one.frame_id), about["source_timestamp"])),
        DEEP,
    )
    say("ready")
    while len(heard) < count:
        rclpy.spin_once(node, timeout_sec=1.0)
    say(json.dumps(sorted(heard, key=lambda one: one[2])))


def main() -> None:
    rclpy.init()
    node = rclpy.create_node("counting")
    {"publish": publish, "hear": hear}[sys.argv[1]](node, *map(int, sys.argv[2:]))


if __name__ == "__main__":
    main()
