"""Asks one node what it declares, within a time."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.signals import SignalHandlerOptions

from orchestra.ros.capture.interfaces import interfaces_of
from orchestra.ros.capture.parameters import parameters_of
from orchestra.ros.observer.participant import hidden_node
from orchestra.ros.observer.service import OwnService

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node

# How long the graph must stay as it is before what is in it counts as all, in seconds.
_QUIET = 1.0
_PAUSE = 0.05


class NoAnswerError(Exception):
    """The node does not say in time what it is asked."""


def answer(name: str, timeout: float, *, interfaces: bool) -> dict[str, Any]:
    """Return what a node declares, as JSON data.

    Else `reason` says why not, and `nodes` are those that are there.
    """
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
    try:
        asking = Asking(hidden_node(), time.monotonic() + timeout)
        if not asking.wait(lambda: name in asking.nodes()):
            return {"reason": "absent", "nodes": asking.nodes()}
        try:
            found: dict[str, Any] = {"parameters": parameters_of(name, asking.ask)}
        except NoAnswerError as error:
            return {"reason": str(error), "nodes": asking.nodes()}
        if interfaces:
            found["interfaces"] = asking.settled(lambda: interfaces_of(name, asking.node))
        return found
    finally:
        rclpy.try_shutdown()


class Asking:
    """A node that asks others, until the monotonic time `until`."""

    def __init__(self, node: Node, until: float) -> None:
        self.node = node
        self._until = until
        self._executor = SingleThreadedExecutor()
        self._executor.add_node(node)

    def nodes(self) -> list[str]:
        """Return the full names of the nodes in the graph, without hidden ones."""
        found = self.node.get_node_names_and_namespaces()
        return sorted({f"{space.rstrip('/')}/{name}" for name, space in found if not name.startswith("_")})

    def wait(self, holds: Callable[[], bool]) -> bool:
        """Wait until something holds; return whether it does."""
        while not holds():
            if time.monotonic() > self._until:
                return False
            self._executor.spin_once(timeout_sec=_PAUSE)
        return True

    def ask(self, kind: Any, service: str, request: Any) -> Any:  # noqa: ANN401 - of an untyped package
        """Return the response of a service. Raises `NoAnswerError`."""
        client = OwnService(self.node, kind, service)
        answers: list[Any] = []
        try:
            if not self.wait(lambda: client.ready):
                raise NoAnswerError(f"it has no service {service}")
            client.ask(request, answers.append, repeat=True)

            def answered() -> bool:
                client.look()
                return bool(answers)

            if not self.wait(answered):
                raise NoAnswerError(f"its service {service} does not answer")
        finally:
            client.close()
        return answers[0]

    def settled(self, look: Callable[[], Any]) -> Any:  # noqa: ANN401 - what is seen
        """Return what is seen in the graph once it stays as it is: what others have is learned bit by bit."""
        seen, since = look(), time.monotonic()
        while time.monotonic() - since < _QUIET:
            self._executor.spin_once(timeout_sec=_PAUSE)
            now = look()
            if now != seen:
                seen, since = now, time.monotonic()
        return seen
