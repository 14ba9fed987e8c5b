"""Listens to the two robots for some simulated seconds and prints what it heard as JSON.

`python listener.py SECONDS`: rates come from the stamps, so that they are in simulated time.
"""

from __future__ import annotations

import json
import math
import statistics
import sys
import time
from collections import defaultdict
from itertools import pairwise
from typing import Any

import rclpy
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu, LaserScan

from orchestra.ros.interfaces import tf_message_type

ROBOTS = ("robot1", "robot2")
TOPICS = {"scan": LaserScan, "imu/data": Imu}
POSES = ("wheel/odometry", "odometry/filtered", "ground_truth")
PATIENCE = 120.0  # seconds of real time


class Listener(Node):
    """Keeps the stamps, frames and last poses of everything it hears."""

    def __init__(self) -> None:
        super().__init__("listener")
        self.stamps: dict[str, list[float]] = defaultdict(list)
        self.frames: dict[str, list[str]] = {}
        self.transforms: dict[str, str] = {}
        self.dynamic: set[str] = set()
        self.tracks: dict[str, dict[float, tuple[float, float, float]]] = defaultdict(dict)
        heard = QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT)
        kept = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_subscription(Clock, "/clock", self._hear_clock, heard)
        for robot in ROBOTS:
            for name, kind in TOPICS.items():
                self._subscribe(kind, f"/{robot}/{name}", heard)
            for name in POSES:
                self._subscribe(Odometry, f"/{robot}/{name}", heard)
        self.create_subscription(
            tf_message_type(), "/tf", lambda message: self._tf(message, moving=True), 100
        )
        self.create_subscription(
            tf_message_type(), "/tf_static", lambda message: self._tf(message, moving=False), kept
        )

    def elapsed(self) -> float:
        """Return how long the clock has been heard, in simulated seconds."""
        clock = self.stamps["/clock"]
        return clock[-1] - clock[0] if clock else 0.0

    def report(self) -> dict[str, Any]:
        """Return what was heard."""
        return {
            "rates": {topic: _rate(stamps) for topic, stamps in self.stamps.items()},
            "frames": self.frames,
            "transforms": self.transforms,
            "moving": sorted(self.dynamic),
            "poses": {robot: self._last_poses(robot) for robot in ROBOTS},
        }

    def _last_poses(self, robot: str) -> dict[str, tuple[float, float, float]]:
        """Return all poses of a robot at the last moment for which all of them were heard."""
        tracks = {name: self.tracks[f"/{robot}/{name}"] for name in POSES}
        moments = set.intersection(*(set(track) for track in tracks.values()))
        return {name: track[max(moments)] for name, track in tracks.items()} if moments else {}

    def _subscribe(self, kind: Any, topic: str, qos: QoSProfile) -> None:
        self.create_subscription(kind, topic, lambda message: self._hear(topic, message), qos)

    def _hear(self, topic: str, message: Any) -> None:
        self.stamps[topic].append(_seconds(message.header.stamp))
        self.frames[topic] = [message.header.frame_id, getattr(message, "child_frame_id", "")]
        if isinstance(message, Odometry):
            pose = message.pose.pose
            yaw = 2 * math.atan2(pose.orientation.z, pose.orientation.w)
            self.tracks[topic][self.stamps[topic][-1]] = (pose.position.x, pose.position.y, yaw)

    def _hear_clock(self, message: Clock) -> None:
        self.stamps["/clock"].append(_seconds(message.clock))

    def _tf(self, message: Any, *, moving: bool) -> None:
        for transform in message.transforms:
            child, parent = transform.child_frame_id, transform.header.frame_id
            assert self.transforms.setdefault(child, parent) == parent, f"{child} has two parents"
            if moving:
                self.dynamic.add(child)
                self.stamps[f"/tf {child}"].append(_seconds(transform.header.stamp))


def _seconds(stamp: Any) -> float:
    return stamp.sec + stamp.nanosec * 1e-9


def _rate(stamps: list[float]) -> float:
    """Return messages per simulated second, by the median distance, so that a lost one does not count."""
    steps = [later - earlier for earlier, later in pairwise(stamps) if later > earlier]
    return 1 / statistics.median(steps) if steps else 0.0


def main() -> None:
    """Listen until the simulated seconds are over."""
    seconds, deadline = float(sys.argv[1]), time.monotonic() + PATIENCE
    rclpy.init()
    listener = Listener()
    while listener.elapsed() < seconds and time.monotonic() < deadline:
        rclpy.spin_once(listener, timeout_sec=1.0)
    print(json.dumps(listener.report()))  # noqa: T201 - the product
    listener.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    main()
