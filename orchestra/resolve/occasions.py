"""Actions that are not carried out by the visit but when something happens: collected first, settled at its end.

A handler may name a process that is visited later, and which processes a matcher means is known when all are there. So
they are kept open; `settling` makes triggers of them when the visit is over.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import islice
from typing import Any, Literal, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.location import Location
from orchestra.resolve.reactions import TriggeredAction
from orchestra.values import EventName


@dataclass(frozen=True, slots=True)
class OpenEvent:
    """What is waited for.

    `target` is None for every process, an object of a Python launch file, or a predicate on such objects.
    `process_completed` of an action that is no process comes as soon as that is carried out.
    """

    event: EventName
    target: Any = None
    stream: Literal["stdout", "stderr"] | None = None
    transition: str | None = None
    start_state: str | None = None
    goal_state: str | None = None


@dataclass(frozen=True, slots=True)
class OpenAction:
    """An action that concerns the processes that `target` means, and what it comes to when they are known."""

    target: Any
    location: Location
    make: Callable[[tuple[int, ...]], TriggeredAction]


@dataclass(frozen=True, slots=True)
class Registration:
    """Arm or disarm what a handler has set up."""

    handler: Any
    location: Location
    armed: bool


Action: TypeAlias = TriggeredAction | OpenAction | Registration


@dataclass(slots=True)
class Occasion:
    """Something that is waited for, and what has been collected to be done then.

    `delay` is in seconds. `handler` is the object that stands for the handler, to be found when it is unregistered.
    `armed` is false where another event has to come first. `now`: it is happening, so that code can be called.
    `timers` are the objects of a Python launch file that go off, the innermost last.
    """

    on: OpenEvent
    location: Location
    delay: float | None = None
    handler: Any = None
    armed: bool = True
    once: bool = False
    cancel_on_shutdown: bool = True
    now: bool = False
    timers: tuple[Any, ...] = ()
    do: list[Action] = field(default_factory=list)


class Occasions:
    """What has been collected, as it is written. What concerns a handler or a timer is found by that."""

    __slots__ = ("_all", "_of_handlers", "_of_timers", "late")

    def __init__(self) -> None:
        self._all: dict[int, Occasion] = {}
        self._of_handlers: dict[int, list[Occasion]] = {}
        self._of_timers: dict[int, Occasion] | None = None
        self.late = 0  # so many come after the start of the run

    def append(self, occasion: Occasion) -> None:
        """Put one behind the others."""
        self._all[id(occasion)] = occasion
        self._of_timers = None
        if occasion.handler is not None:
            self._of_handlers.setdefault(id(occasion.handler), []).append(occasion)
        if _is_late(occasion):
            self.late += 1

    def forget(self, handler: Any) -> None:  # noqa: ANN401 - an event handler of any class
        """Forget what a handler waits for."""
        self._of_timers = None
        for occasion in self._of_handlers.pop(id(handler), ()):
            del self._all[id(occasion)]
            if _is_late(occasion):
                self.late -= 1

    def of_timer(self, timer: Any) -> Occasion | None:  # noqa: ANN401 - an object of a Python launch file
        """Return the first one that comes when a timer goes off."""
        if self._of_timers is None:
            self._of_timers = {}
            for occasion in self:
                if occasion.timers:
                    self._of_timers.setdefault(id(occasion.timers[-1]), occasion)
        return self._of_timers.get(id(timer))

    def __iter__(self) -> Iterator[Occasion]:
        done = 0
        while done < len(self._all):  # code that is called meanwhile may put more behind them
            rest = tuple(islice(self._all.values(), done, None))
            done += len(rest)
            yield from rest

    def __len__(self) -> int:
        return len(self._all)


def _is_late(occasion: Occasion) -> bool:
    return occasion.delay is not None or occasion.on.event != "run_started"
