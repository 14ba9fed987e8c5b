"""Orders to nodes, given through the observer, with limits of time for each step."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from orchestra.supervise.graph.observation import Observers
    from orchestra.supervise.loop import Loop, Timer


class Limits(NamedTuple):
    """How long, in seconds, a service is awaited until it is there, and then its answer."""

    service: float
    answer: float


class Order(NamedTuple):
    """What is asked of a node: what the observer is told, and the service behind it.

    `environment` is that of a process which sees the node.
    """

    name: str
    message: Mapping[str, Any]
    service: str
    environment: Mapping[str, str]


class Refusal(NamedTuple):
    """Why an order was not carried out; `absent` says that nobody was there to take it."""

    reason: str
    absent: bool = False


class Orders:
    """Gives orders, and waits for what comes of them no longer than the limits say; `settled` hears of each end."""

    def __init__(self, observers: Observers, loop: Loop, limits: Limits, settled: Callable[[], None]) -> None:
        self._observers = observers
        self._loop = loop
        self._limits = limits
        self._settled = settled
        self._timers: dict[str, Timer] = {}

    def give(
        self, order: Order, done: Callable[[dict[str, Any]], None], failed: Callable[[Refusal], None]
    ) -> None:
        """Give an order; exactly one of `done` and `failed` is called, unless it is withdrawn."""

        def heard(message: dict[str, Any]) -> None:
            if message["say"] == "asking":
                time(self._limits.answer, f"{order.service} did not answer")
                return
            self._stop_clock(order.name)
            if message["say"] == "done":
                done(message)
            else:
                failed(Refusal(message["reason"]))
            self._settled()

        def time(limit: float, what: str, *, absent: bool = False) -> None:
            self._stop_clock(order.name)
            refusal = Refusal(f"{what} within {limit:g} s", absent)
            self._timers[order.name] = self._loop.call_later(limit, lambda: expired(refusal))

        def expired(refusal: Refusal) -> None:
            self.withdraw(order.name)
            failed(refusal)
            self._settled()

        time(self._limits.service, f"there was no service {order.service}", absent=True)
        self._observers.order(order.name, order.message, order.environment, heard)

    def withdraw(self, name: str) -> None:
        """Wait for an order no more."""
        self._stop_clock(name)
        self._observers.forget(name)

    def _stop_clock(self, name: str) -> None:
        timer = self._timers.pop(name, None)
        if timer:
            timer.cancel()
