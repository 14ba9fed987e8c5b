"""Actions that are not carried out by the visit but when something happens: collected first, settled at its end.

A handler may name a process that is visited later, and which processes a matcher means is known when all are there. So
they are kept open; `settling` makes triggers of them when the visit is over.
"""

from __future__ import annotations

from collections.abc import Callable
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
