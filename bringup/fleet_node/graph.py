"""What the graph shows of robots."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bringup.fleet.discovery import Presence, inside, robot_of_topic, robots

if TYPE_CHECKING:
    from collections.abc import Collection

    from rclpy.node import Node

    from bringup.fleet.settings import Settings

_ODOMETRY = "nav_msgs/msg/Odometry"


def present(node: Node, settings: Settings, watched: Collection[str]) -> dict[str, Presence]:
    """Return the robots that are in the graph now; of those that are watched, also by whom they are driven.

    A topic alone is no robot: the monitor's own subscription holds it in the graph for ever.
    """
    published = [
        topic
        for topic, types in node.get_topic_names_and_types()
        if _ODOMETRY in types
        and robot_of_topic(topic, settings.odometry) is not None
        and node.count_publishers(topic)
    ]
    found = robots(published, node.get_node_names_and_namespaces(), settings.odometry, settings.controller)
    return {
        name: replace(each, controllers=controllers(node, name, settings)) if name in watched else each
        for name, each in found.items()
    }


def controllers(node: Node, robot: str, settings: Settings) -> frozenset[str]:
    """Return the ids of those who publish a robot's mode: one that starts again has another."""
    if not settings.controller:
        return frozenset()
    publishers = node.get_publishers_info_by_topic(mode_topic(robot, settings))
    return frozenset(bytes(each.endpoint_gid).hex() for each in publishers)


def mode_topic(robot: str, settings: Settings) -> str:
    """Return the topic on which the controller of a robot tells its mode."""
    return inside(robot, f"{settings.controller}/mode")
