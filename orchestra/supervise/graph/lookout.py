"""The orders that are open in one part of the middleware, and the observer that carries them out.

An observer that dies, hangs or talks nonsense is replaced, once in a while, and given its orders again: looking and
listening begin anew, and a transition that has been made meanwhile is not asked for again. A component that may have
been loaded is not: the same one twice is worse than an error.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.supervise.graph import dialogue

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from orchestra.supervise.graph import observer
    from orchestra.supervise.graph.observer import Observer
    from orchestra.supervise.loop import Loop, Timer

    # Who hears what the observer says to one order.
    Heard: TypeAlias = Callable[[dict[str, Any]], None]
    Start: TypeAlias = Callable[[tuple[observer.Heard, observer.Lost]], Observer]

# Orders that only look and listen, those to which an answer is awaited all the time, and one that must not be repeated.
_LOOKING = ("watch", "rate", "transitions")
_AWAITED = ("watch", "rate", "change_state", "load")
_ONCE = "load"


class Patience(NamedTuple):
    """In seconds. While something is awaited, the observer is asked `every` so often whether it still answers.

    It has to within `answer`, or within `start` before its first answer. One that is lost is replaced unless another
    one was within `lasting`.
    """

    every: float = 5.0
    answer: float = 15.0
    start: float = 60.0
    lasting: float = 60.0


@dataclass(slots=True)
class _Open:
    """An order, who hears of it, and whether it has come so far that a node has been asked something.

    Its id is its own: an answer to an earlier order of the same name may still be on its way.
    """

    id: str
    order: Mapping[str, Any]
    heard: Heard
    asked: bool = False


class Lookout:
    """Keeps an observer at work as long as there is something to do. `told` gets what users should know of it."""

    def __init__(self, loop: Loop, start: Start, told: Callable[[str], None], patience: Patience) -> None:
        self._loop = loop
        self._start = start
        self._told = told
        self._patience = patience
        self._observer: Observer | None = None
        self._former: list[Observer] = []
        self._open: dict[str, _Open] = {}
        self._numbers = itertools.count(1)
        self._dropped = False
        self._replaced_at: float | None = None
        self._timer: Timer | None = None
        self._unanswered = 0
        self._answers = False

    @property
    def alive(self) -> Sequence[Observer]:
        """Its observers whose process has not been reaped."""
        self._former = [one for one in self._former if one.alive]
        return [*self._former, *([self._observer] if self._observer and self._observer.alive else [])]

    def prepare(self) -> Observer:
        """Return the observer, started where there is none. Raises `OSError`."""
        if self._observer is None or self._observer.leaving:
            self._retire()
            self._unanswered, self._answers = 0, False
            self._observer = self._start((self._heard, self._lost))
        return self._observer

    def order(self, name: str, order: Mapping[str, Any], heard: Heard) -> None:
        """Have something done; `heard` gets everything that is said to it."""
        if self._dropped and order["do"] in _LOOKING:
            return
        self._open[name] = one = _Open(f"{next(self._numbers)} {name}", order, heard)
        try:
            self.prepare().tell({"id": one.id, **order})
        except OSError as error:
            self._fail([name], f"the observer could not be started: {error}")
        self._attend()

    def forget(self, name: str) -> None:
        """Take an order back."""
        one = self._open.pop(name, None)
        if one and self._observer:
            self._observer.tell({"forget": one.id})

    def drop(self) -> None:
        """Look out for nothing any more, whoever asks; what nodes are asked goes on."""
        self._dropped = True
        for name in [name for name, one in self._open.items() if one.order["do"] in _LOOKING]:
            self.forget(name)

    def relieve(self) -> None:
        """Let the observer end where there is nothing to do."""
        if not self._open and self._observer:
            self._observer.leave()

    def leave(self) -> None:
        """Let the observer end, whatever is still to do."""
        self._open.clear()
        self.relieve()

    def _heard(self, observer: Observer, message: dict[str, Any]) -> None:
        if observer is not self._observer:
            return
        if "pong" in message:
            self._unanswered, self._answers = 0, True
            return
        _, _, name = message["id"].partition(" ")
        one = self._open.get(name)
        if one is None or one.id != message["id"]:  # taken back while the answer was on its way
            return
        if not dialogue.fits(message, one.order["do"]):
            observer.kill()
            self._lost(observer, f"said what nobody understands: {message}")
            return
        one.asked = one.asked or message["say"] == "asking"
        if dialogue.is_final(message):
            del self._open[name]
        one.heard(message)

    def _lost(self, observer: Observer, why: str) -> None:
        if observer is not self._observer:
            return
        self._retire()
        if not self._open:
            return
        reason = f"the observer, which looks into the ROS graph, {why}"
        if observer.hopeless:
            self._fail([*self._open], f"{reason} before it had begun")
            return
        now, before = self._loop.clock(), self._replaced_at
        self._replaced_at = now
        if before is not None and now < before + self._patience.lasting:
            self._fail([*self._open], f"{reason}, and so did the one before")
            return
        self._told(f"{why}; it is started again")
        self._fail(
            [name for name, one in self._open.items() if one.asked and one.order["do"] == _ONCE], reason
        )
        self._again()

    def _again(self) -> None:
        """Give a new observer all that is open."""
        try:
            observer = self.prepare() if self._open else None
        except OSError as error:
            self._fail([*self._open], f"the observer could not be started again: {error}")
            return
        for one in [*self._open.values()]:
            if observer and observer is self._observer:  # it may be lost already
                observer.tell({"id": one.id, **one.order, "again": True})
        self._attend()

    def _fail(self, names: Sequence[str], reason: str) -> None:
        for name in names:
            one = self._open.pop(name, None)
            if one:
                one.heard({"id": name, "say": "impossible", "reason": reason})

    def _retire(self) -> None:
        if self._observer:
            self._former.append(self._observer)
        self._observer = None

    def _attend(self) -> None:
        """Ask for a sign of life as long as something is awaited."""
        if self._timer is None and any(one.order["do"] in _AWAITED for one in self._open.values()):
            self._timer = self._loop.call_later(self._patience.every, self._ask)

    def _ask(self) -> None:
        """Asks are counted, not seconds: while we were stopped ourselves, the observer could not answer."""
        self._timer = None
        observer = self._observer
        if observer is None or not any(one.order["do"] in _AWAITED for one in self._open.values()):
            self._unanswered = 0
            return
        limit = self._patience.answer if self._answers else self._patience.start
        if self._unanswered * self._patience.every >= limit:
            observer.kill()
            self._lost(observer, f"has not answered for {limit:g} s")
        else:
            self._unanswered += 1
            observer.tell({"ping": self._unanswered})
        self._attend()
