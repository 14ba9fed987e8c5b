"""The kinds of orders and of facts: each is a module and what in it makes the order.

They are imported when they are first asked for: whoever only waits for a message need not load the others.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import TypeAlias

    from rclpy.node import Node

    from orchestra.ros.observer.order import Order, Request, Say

    Make: TypeAlias = Callable[[Node, Request, Say], Order]

# By what `do` says.
ORDERS = {
    "rate": ("rate", "Rate"),
    "transitions": ("transitions", "Transitions"),
    "stay": ("stay", "Stay"),
    "change_state": ("state_change", "StateChange"),
    "load": ("component", "ComponentLoad"),
}
# What can be watched, by what `fact` says.
FACTS = {
    "node": ("facts.node", "node_there"),
    "topic": ("facts.topic", "topic_there"),
    "message": ("facts.message", "FirstMessage"),
    "service": ("facts.service", "service_there"),
    "action": ("facts.action", "action_there"),
    "parameter": ("facts.parameter", "ParameterThere"),
    "lifecycle": ("facts.lifecycle", "StateReached"),
    "tf": ("facts.tf", "TransformThere"),
}


def maker(request: Request) -> Make:
    """Return what makes the order. Raises `KeyError` where it is of no kind that is here."""
    module, name = FACTS[request["fact"]] if request["do"] == "watch" else ORDERS[request["do"]]
    make: Make = getattr(import_module(f"orchestra.ros.observer.{module}"), name)
    return make
