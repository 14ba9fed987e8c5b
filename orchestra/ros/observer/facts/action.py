"""An action has a server.

An action is three services and two topics; it is there when all of them are, as `rcl_action_server_is_available` has it
(rcl_action/src/rcl_action/action_client.c).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.ros.observer.facts.seen import Seen

if TYPE_CHECKING:
    from rclpy.node import Node

    from orchestra.ros.observer.order import Request, Say

_SERVICES = ("send_goal", "cancel_goal", "get_result")
_TOPICS = ("feedback", "status")


def action_there(node: Node, request: Request, say: Say) -> Seen:
    """`name` is the full name of the action."""
    name: str = request["name"]

    def there(eyes: Node) -> bool:
        return all(eyes.count_services(f"{name}/_action/{part}") for part in _SERVICES) and all(
            eyes.count_publishers(f"{name}/_action/{part}") for part in _TOPICS
        )

    return Seen(node, say, there)
