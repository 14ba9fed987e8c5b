"""A service has a server; clients alone do not count."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.ros.observer.facts.seen import Seen

if TYPE_CHECKING:
    from rclpy.node import Node

    from orchestra.ros.observer.order import Request, Say


def service_there(node: Node, request: Request, say: Say) -> Seen:
    """`name` is the full name of the service."""
    name: str = request["name"]
    return Seen(node, say, lambda eyes: bool(eyes.count_services(name)))
