"""Carries out orders. The graph is looked at ten times a second, and only while an order needs it.

rclpy shows no graph event, so polling it is; one look costs some microseconds. Orders are read by a thread of their
own, which hands them to the executor, so that none waits for the next look.
"""

from __future__ import annotations

import json
import os
import threading
from functools import partial
from importlib import import_module
from queue import SimpleQueue
from typing import TYPE_CHECKING, Any

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.signals import SignalHandlerOptions

if TYPE_CHECKING:
    from rclpy.node import Node

    from orchestra.ros.observer.order import Order

_LOOK_EVERY = 0.1
# What `do` says, the module and its class: who only waits for a message need not load the others.
_KINDS = {
    "watch": ("first_message", "FirstMessage"),
    "transitions": ("transitions", "Transitions"),
    "change_state": ("state_change", "StateChange"),
    "load": ("component", "ComponentLoad"),
}


class Desk:
    """The orders at work. `answers` is the descriptor that what is said to them is written to."""

    def __init__(self, node: Node, answers: int) -> None:
        self._node = node
        self._answers = answers
        self._orders: dict[str, Order] = {}
        self._over: set[str] = set()
        self.closed = False

    @property
    def looks(self) -> bool:
        """Whether an order needs the graph to be looked at."""
        return any(order.looks for order in self._orders.values())

    def take(self, requests: SimpleQueue[dict[str, Any] | None]) -> None:
        """Take what has come, in its order; None is the end."""
        while not requests.empty():
            request = requests.get()
            if request is None:
                self.closed = True
            else:
                self._begin(request)
        self.look()

    def _begin(self, request: dict[str, Any]) -> None:
        """Begin with an order, or forget one."""
        if "forget" in request:
            self._drop(request["forget"])
            return
        name = request["id"]
        module, kind = _KINDS[request["do"]]
        make = getattr(import_module(f"orchestra.ros.observer.{module}"), kind)
        self._over.discard(name)
        self._drop(name)
        self._orders[name] = make(self._node, request, partial(self._say, name))

    def look(self) -> None:
        """Look at the graph for all who need it, and clear away what is over."""
        for order in [*self._orders.values()]:
            if order.looks:
                order.look()
        while self._over:
            self._drop(self._over.pop())

    def _drop(self, name: str) -> None:
        order = self._orders.pop(name, None)
        if order:
            order.close()

    def _say(self, name: str, word: str, **facts: Any) -> None:  # noqa: ANN401 - JSON
        if word in ("done", "impossible"):
            self._over.add(name)
        os.write(self._answers, (json.dumps({"id": name, "say": word, **facts}) + "\n").encode())


def observe(requests: int, answers: int) -> None:
    """Serve the supervisor on two descriptors until the first one ends."""
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
    try:
        # The underscore makes it a hidden node, which tools leave out.
        node = rclpy.create_node(
            f"_orchestra_observer_{os.getpid()}",
            start_parameter_services=False,
            enable_rosout=False,
            use_global_arguments=False,
        )
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        _serve(requests, Desk(node, answers), executor)
        executor.shutdown()
        node.destroy_node()
    finally:
        rclpy.try_shutdown()


def _serve(requests: int, desk: Desk, executor: SingleThreadedExecutor) -> None:
    threading.Thread(target=_read, args=(requests, desk, executor), daemon=True).start()
    while not desk.closed:
        executor.spin_once(timeout_sec=_LOOK_EVERY if desk.looks else None)
        desk.look()


def _read(requests: int, desk: Desk, executor: SingleThreadedExecutor) -> None:
    """Wake the executor's thread for each order; tasks would be carried out in another order than they were made."""
    waiting: SimpleQueue[dict[str, Any] | None] = SimpleQueue()
    with os.fdopen(requests, "rb", closefd=False) as stream:
        for line in stream:
            waiting.put(json.loads(line))
            executor.create_task(desk.take, waiting)
    waiting.put(None)
    executor.create_task(desk.take, waiting)
