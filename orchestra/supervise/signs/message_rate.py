"""Sign of life: messages come often enough on a topic, as the observer sees it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.supervise.signs.deadline import LATE, Deadline

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from orchestra.supervise.graph.observation import Observers
    from orchestra.supervise.loop import Loop

# How long the observer may take to start and to be matched with the publishers: until it has seen enough messages once,
# it may be its own fault that it sees none. In seconds.
_ACQUAINTANCE = 5.0
# An observer that has said nothing for so long, besides two windows, is asked anew, in seconds.
_SILENCE = 10.0


class MessageRate:
    """Expects messages on a topic, at least `least` a second on the average of a window, or any where that is None.

    `silent` is told that there are too few; False says that this is no hang. `blind` hears why nobody can tell. What
    the observer says counts only where it comes at its usual pace: not after either of us was stopped.
    """

    def __init__(
        self,
        loop: Loop,
        observers: Observers,
        environment: Callable[[], Mapping[str, str]],
        name: str,
        wanted: tuple[str, float | None, float],
        silent: Callable[[str], bool],
        blind: Callable[[str], None],
    ) -> None:
        self._loop = loop
        self._observers = observers
        self._environment = environment
        self._name = name
        self._topic, self._least, self._window = wanted
        self._silent = silent
        self._blind = blind
        self._counts_from: float | None = None
        self._heard_at = 0.0
        self._reports = Deadline(loop, self._ask)

    def begin(self, *, armed: bool) -> None:
        """Expect them from now on; where it is not armed, from the first time on that there were enough."""
        known_by = max(_ACQUAINTANCE, 2 * self._window)
        self._counts_from = self._loop.clock() + known_by if armed else None
        self._ask()

    def end(self) -> None:
        """Expect nothing any more."""
        self._reports.end()
        self._observers.forget(self._name)

    def _ask(self) -> None:
        self._reports.begin(2 * self._window + _SILENCE)
        self._heard_at = self._loop.clock()
        self._observers.forget(self._name)
        order = {"do": "rate", "topic": self._topic, "window": self._window}
        self._observers.order(self._name, order, self._environment(), self._heard)

    def _heard(self, message: dict[str, Any]) -> None:
        if message["say"] == "impossible":
            self._reports.end()
            self._blind(message["reason"])
            return
        if message["say"] != "rate":
            return
        now = self._loop.clock()
        usual = 0.5 * self._window <= now - self._heard_at <= 2 * self._window + LATE
        self._heard_at = now
        self._reports.sign()
        rate = float(message["rate"])
        if rate > 0 and (self._least is None or rate >= self._least):
            self._counts_from = 0.0
        elif usual and self._counts_from is not None and now >= self._counts_from:
            self._too_few(rate)

    def _too_few(self, rate: float) -> None:
        what = f"{rate:.3g} messages a second" if rate > 0 else "no message"
        wanted = "" if self._least is None else f", at least {self._least:g} a second are wanted"
        self._silent(f"{what} on {self._topic} for {self._window:g} s{wanted}")
