"""What is done when something happens: resolved triggers, in which processes and components are numbers."""

from __future__ import annotations

from typing import Literal, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.location import Location
from orchestra.values import EventName, Level


@dataclass(frozen=True, slots=True)
class ResolvedEvent:
    """What is waited for; `target` is the index of a process, None for every one. See `plan.reactions.TriggerEvent`."""

    event: EventName
    target: int | None = None
    stream: Literal["stdout", "stderr"] | None = None
    transition: str | None = None
    start_state: str | None = None
    goal_state: str | None = None


@dataclass(frozen=True, slots=True)
class ResolvedLog:
    """Tell the user something."""

    message: str
    location: Location
    level: Level = "info"


@dataclass(frozen=True, slots=True)
class ResolvedStart:
    """Start the process at `index` of the resolved processes."""

    index: int
    location: Location


@dataclass(frozen=True, slots=True)
class ResolvedLoad:
    """Load the component at `index` of the resolved components."""

    index: int
    location: Location


@dataclass(frozen=True, slots=True)
class ResolvedStop:
    """End processes."""

    indexes: tuple[int, ...]
    location: Location


@dataclass(frozen=True, slots=True)
class ResolvedSignal:
    """Send a signal, by its full name, to processes."""

    indexes: tuple[int, ...]
    signal: str
    location: Location


@dataclass(frozen=True, slots=True)
class ResolvedChangeState:
    """Take lifecycle nodes through transitions, given by their ids."""

    indexes: tuple[int, ...]
    transitions: tuple[int, ...]
    location: Location


@dataclass(frozen=True, slots=True)
class ResolvedRegister:
    """Arm the trigger at `index` of the resolved triggers."""

    index: int
    location: Location


@dataclass(frozen=True, slots=True)
class ResolvedUnregister:
    """Disarm the trigger at `index` of the resolved triggers."""

    index: int
    location: Location


@dataclass(frozen=True, slots=True)
class ResolvedCancel:
    """Disarm the trigger at `index` of the resolved triggers, and drop what its delay puts off."""

    index: int
    location: Location


@dataclass(frozen=True, slots=True)
class ResolvedShutdown:
    """End the run."""

    reason: str
    location: Location


@dataclass(frozen=True, slots=True)
class ResolvedDeferred:
    """Ask code of the description, which the resolution keeps under `ref`."""

    ref: int
    location: Location


TriggeredAction: TypeAlias = (
    ResolvedLog
    | ResolvedStart
    | ResolvedLoad
    | ResolvedStop
    | ResolvedSignal
    | ResolvedChangeState
    | ResolvedRegister
    | ResolvedUnregister
    | ResolvedCancel
    | ResolvedShutdown
    | ResolvedDeferred
)


@dataclass(frozen=True, slots=True)
class ResolvedTrigger:
    """Actions to carry out `delay` seconds after an event. See `plan.reactions.Trigger`."""

    on: ResolvedEvent
    do: tuple[TriggeredAction, ...]
    delay: float | None
    location: Location
    armed: bool = True
    once: bool = False
    cancel_on_shutdown: bool = True
