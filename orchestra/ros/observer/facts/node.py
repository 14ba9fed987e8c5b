"""A node is in the graph."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.ros.observer.facts.seen import Seen

if TYPE_CHECKING:
    from rclpy.node import Node

    from orchestra.ros.observer.order import Request, Say


def node_there(node: Node, request: Request, say: Say) -> Seen:
    """`name` is the full name of the node."""
    name: str = request["name"]
    return Seen(node, say, lambda eyes: name in eyes.get_fully_qualified_node_names())
