"""The orders at work, and when each of them is looked after."""

from __future__ import annotations

import json
import os
import time
from functools import partial
from typing import TYPE_CHECKING, Any

from orchestra.ros.observer.kinds import maker
from orchestra.ros.observer.order import ImpossibleError

if TYPE_CHECKING:
    from collections.abc import Callable
    from queue import SimpleQueue

    from rclpy.node import Node

    from orchestra.ros.observer.order import Order


# After looks that took so long, this many times as long belongs to what nodes say: on a busy machine, or with many
# orders, the one look would else follow the other, and answers would wait while they are asked for again.
_REST = 4.0


class Desk:
    """Carries out orders. `answers` is the descriptor that what is said to them is written to."""

    def __init__(self, node: Node, answers: int) -> None:
        self._node = node
        self._answers = answers
        self._orders: dict[str, Order] = {}
        self._due: dict[str, float] = {}
        self._rest_until = 0.0
        self._over: set[str] = set()
        self.closed = False

    @property
    def pause(self) -> float | None:
        """The time in seconds until something is to be looked at, None where nothing is."""
        if not self._due:
            return None
        return max(0.0, max(min(self._due.values()), self._rest_until) - time.monotonic())

    def greet(self) -> None:
        """Say, once, that we are in the graph."""
        self._write({"pong": 0})

    def take(self, requests: SimpleQueue[dict[str, Any] | None]) -> None:
        """Take what has come, in its order; None is the end."""
        while not requests.empty():
            request = requests.get()
            if request is None:
                self.closed = True
            elif "ping" in request:
                self._write({"pong": request["ping"]})
            elif "forget" in request:
                self._drop(request["forget"])
            else:
                self._begin(request["id"], request)
        self.look()

    def look(self) -> None:
        """Look at what is due, and clear away what is over."""
        now = time.monotonic()
        if now >= self._rest_until:
            for name in [name for name, due in self._due.items() if due <= now]:
                self._attempt(name, self._orders[name].look)
                self._time(name)
            end = time.monotonic()
            self._rest_until = end + _REST * (end - now)
        while self._over:
            self._drop(self._over.pop())

    def _begin(self, name: str, request: dict[str, Any]) -> None:
        self._over.discard(name)
        self._drop(name)

        def begin() -> None:
            order = maker(request)(self._node, request, partial(self._say, name))
            self._orders[name] = order
            if order.every is not None:
                self._due[name] = time.monotonic()

        self._attempt(name, begin)

    def _attempt(self, name: str, step: Callable[[], None]) -> None:
        """Take a step of an order; whatever it raises is the end of this order alone."""
        try:
            step()
        except ImpossibleError as error:
            self._say(name, "impossible", reason=str(error))
        except Exception as error:  # noqa: BLE001 - the boundary of one order: the others go on
            self._say(name, "impossible", reason=f"{type(error).__name__}: {error}")

    def _time(self, name: str) -> None:
        every = self._orders[name].every
        if every is None:
            del self._due[name]
        else:
            self._due[name] = time.monotonic() + every

    def _drop(self, name: str) -> None:
        self._due.pop(name, None)
        order = self._orders.pop(name, None)
        if order:
            order.close()

    def _say(self, name: str, word: str, **facts: Any) -> None:  # noqa: ANN401 - JSON
        if word in ("done", "impossible"):
            self._over.add(name)
        self._write({"id": name, "say": word, **facts})

    def _write(self, message: dict[str, Any]) -> None:
        os.write(self._answers, (json.dumps(message) + "\n").encode())
