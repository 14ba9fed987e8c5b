"""Listens to the transitions of a lifecycle node.

rcl_lifecycle of Jazzy publishes only the two states of a transition and leaves its label empty. It follows from them,
by the state machine of rcl_lifecycle (`rcl_lifecycle/src/default_state_machine.c`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from lifecycle_msgs.msg import TransitionEvent

if TYPE_CHECKING:
    from rclpy.node import Node

    from orchestra.ros.observer.order import Request, Say

_DEPTH = 100
# The label of the transition that begins with a state on the way, and the states in which it may end well.
_BEGINS = {
    "configuring": "configure",
    "cleaningup": "cleanup",
    "activating": "activate",
    "deactivating": "deactivate",
    "shuttingdown": "shutdown",
}
_SUCCEEDS = {
    ("configuring", "inactive"),
    ("cleaningup", "unconfigured"),
    ("activating", "active"),
    ("deactivating", "inactive"),
    ("shuttingdown", "finalized"),
    ("errorprocessing", "unconfigured"),
}


def label_of(start: str, goal: str) -> str:
    """Return the label of the transition between two states; empty where the state machine has none."""
    if goal in _BEGINS:
        return _BEGINS[goal]
    if goal == "errorprocessing":
        return "transition_error"
    if (start, goal) in _SUCCEEDS:
        return "transition_success"
    return "transition_failure" if start in (*_BEGINS, "errorprocessing") else ""


class Transitions:
    """`node` is the full name of the node."""

    every = None

    def __init__(self, node: Node, request: Request, say: Say) -> None:
        self._node = node
        self._say = say
        self._subscription = node.create_subscription(
            TransitionEvent, f"{request['node']}/transition_event", self._came, _DEPTH
        )
        say("watching")

    def look(self) -> None:
        """Nothing has to be looked for."""

    def close(self) -> None:
        """Give the subscription back."""
        self._node.destroy_subscription(self._subscription)

    def _came(self, event: TransitionEvent) -> None:
        start, goal = event.start_state.label, event.goal_state.label
        label = event.transition.label or label_of(start, goal)
        self._say("moved", transition=label, start_state=start, goal_state=goal)
