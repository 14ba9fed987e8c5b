"""Listens to the transitions of a lifecycle node.

rcl_lifecycle of Jazzy publishes only the two states of a transition and leaves its label empty. It follows from them,
by the state machine of rcl_lifecycle (`rcl_lifecycle/src/default_state_machine.c`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.ros.observer.peer import peers_of

if TYPE_CHECKING:
    from lifecycle_msgs.msg import TransitionEvent
    from rclpy.node import Node

    from orchestra.ros.observer.order import Request, Say

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


def consequence(before: str, after: str) -> str:
    """Return what is to be said behind the states of a transition that failed: how it came there, and what can follow.

    Only an error leads to `finalized`, or from a later state back to `unconfigured`; where the node stays in its
    state, its events alone tell an error that it has handled from a plain no.
    """
    if after == "finalized":
        return ": it could not handle an error (`on_error`), and only a new start brings it back"
    if after == "unconfigured" and before != after:
        return ": it has handled an error (`on_error`), and can be configured again"
    return ""


class Transitions:
    """`node` is the full name of the node."""

    every = None

    def __init__(self, node: Node, request: Request, say: Say) -> None:
        self._say = say
        self._peers = peers_of(node)
        self._name = request["node"]
        self._listeners = self._peers.join(self._name).listeners
        self._listeners.add(self._came)
        say("watching")

    def look(self) -> None:
        """Nothing has to be looked for."""

    def close(self) -> None:
        """Listen no more."""
        self._listeners.discard(self._came)
        self._peers.leave(self._name)

    def _came(self, event: TransitionEvent) -> None:
        start, goal = event.start_state.label, event.goal_state.label
        label = event.transition.label or label_of(start, goal)
        self._say("moved", transition=label, start_state=start, goal_state=goal)
