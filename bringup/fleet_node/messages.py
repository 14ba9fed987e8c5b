"""Fills what the monitor publishes."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, TypeAlias

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import PoseStamped

from bringup.fleet.robots import Health, health
from bringup.fleet_node.ears import NANOSECONDS
from bringup.fleet_node.interfaces import FleetSummary, RobotSummary

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from bringup.fleet.frames import Frames, Place
    from bringup.fleet.robots import Limits, Robot

Message: TypeAlias = Any


def robot_summary(
    robot: Robot, goal: Message | None, frames: Frames, now: tuple[int, int], limits: Limits
) -> Message:
    """Fill RobotSummary; `now` is ROS time and the time of a clock that never stands, in ns."""
    level, reasons = health(robot, *now, limits)
    age = robot.age(now[0])
    summary = RobotSummary(
        name=robot.name,
        mode=robot.mode,
        has_goal=goal is not None,
        age=-1.0 if age is None else age,
        contacts=robot.contacts,
        health=int(level),
        reasons=list(reasons),
    )
    if robot.motion is not None:
        summary.pose = _pose(frames.rooted(robot.motion.place), robot.motion.made)
        summary.speed, summary.turn_rate = robot.motion.speed, robot.motion.turn_rate
    if goal is not None:
        summary.goal = goal
    return summary


def fleet_summary(robots: list[Message], now: int) -> Message:
    """Fill FleetSummary."""
    summary = FleetSummary(robots=robots)
    summary.header.stamp.sec, summary.header.stamp.nanosec = divmod(now, NANOSECONDS)
    return summary


def diagnostics(node: str, robots: Iterable[Message], doubts: Sequence[str], now: int) -> Message:
    """Fill DiagnosticArray: a status for each robot, and one of the monitor itself, which is in doubt for reasons."""
    array = DiagnosticArray()
    array.header.stamp.sec, array.header.stamp.nanosec = divmod(now, NANOSECONDS)
    array.status = [_robot_status(node, each) for each in robots]
    own = DiagnosticStatus(name=f"{node}: fleet", hardware_id="fleet", message=f"{len(array.status)} robots")
    if doubts:
        own.level, own.message = bytes([Health.WARN]), "; ".join(doubts)
    array.status = [own, *array.status]
    return array


def _robot_status(node: str, robot: Message) -> Message:
    told = "; ".join(robot.reasons) or "well"
    status = DiagnosticStatus(name=f"{node}: {robot.name}", hardware_id="fleet", message=told)
    status.level = bytes([robot.health])
    values = {"age": f"{robot.age:.3f}", "speed": f"{robot.speed:.3f}", "mode": robot.mode}
    status.values = [KeyValue(key=key, value=value) for key, value in values.items()]
    return status


def _pose(place: Place, made: int) -> Message:
    message = PoseStamped()
    message.header.frame_id = place.frame
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(made, NANOSECONDS)
    message.pose.position.x, message.pose.position.y = place.x, place.y
    message.pose.orientation.z, message.pose.orientation.w = math.sin(place.yaw / 2), math.cos(place.yaw / 2)
    return message
