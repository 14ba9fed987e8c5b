"""Triggers of a plan: what happens during a run, and what is done then."""

from __future__ import annotations

from typing import Literal, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.location import Location
from orchestra.values import EventName, Level


@dataclass(frozen=True, slots=True)
class TriggerEvent:
    """What sets a trigger off.

    `target` is the id of a process, None for every one. `process_exited` is every end of a process, respawned ones
    included, `process_completed` the last one. `process_output` is some bytes of `stream`. `state_changed` is a
    transition of a lifecycle node, narrowed by `transition` and by the labels of its two states where they are given.
    `shutdown` is the beginning of the end of the run.
    """

    event: EventName
    target: str | None = None
    stream: Literal["stdout", "stderr"] | None = None
    transition: str | None = None
    start_state: str | None = None
    goal_state: str | None = None


@dataclass(frozen=True, slots=True)
class LogAction:
    """Tell the user something."""

    message: str
    location: Location
    level: Level = "info"
    action: Literal["log"] = "log"


@dataclass(frozen=True, slots=True)
class StartAction:
    """Start a process of the plan, which then does not start with the run."""

    process: str
    location: Location
    action: Literal["start"] = "start"


@dataclass(frozen=True, slots=True)
class LoadAction:
    """Load a component of the plan, which then is not loaded with the start of its container."""

    component: str
    location: Location
    action: Literal["load"] = "load"


@dataclass(frozen=True, slots=True)
class StopAction:
    """End processes as their `stop` says; nothing starts them again."""

    processes: tuple[str, ...]
    location: Location
    action: Literal["stop"] = "stop"


@dataclass(frozen=True, slots=True)
class SignalAction:
    """Send a signal (`SIGUSR1`) to processes."""

    processes: tuple[str, ...]
    signal: str
    location: Location
    action: Literal["signal"] = "signal"


@dataclass(frozen=True, slots=True)
class ChangeStateAction:
    """Take lifecycle nodes through transitions, in order, each as soon as the one before has reached its goal.

    `transitions` are ids of lifecycle_msgs/msg/Transition: 1 configure, 2 clean up, 3 activate, 4 deactivate,
    5, 6, 7 shut down from unconfigured, inactive, active. `processes` are plan ids.
    """

    processes: tuple[str, ...]
    transitions: tuple[int, ...]
    location: Location
    action: Literal["change_state"] = "change_state"


@dataclass(frozen=True, slots=True)
class RegisterAction:
    """From now on a trigger, which was not armed, waits for its event."""

    trigger: str
    location: Location
    action: Literal["register"] = "register"


@dataclass(frozen=True, slots=True)
class UnregisterAction:
    """From now on a trigger waits no more."""

    trigger: str
    location: Location
    action: Literal["unregister"] = "unregister"


@dataclass(frozen=True, slots=True)
class CancelAction:
    """From now on a trigger waits no more, and what its delay puts off is dropped."""

    trigger: str
    location: Location
    action: Literal["cancel"] = "cancel"


@dataclass(frozen=True, slots=True)
class ShutdownAction:
    """End the run."""

    reason: str
    location: Location
    action: Literal["shutdown"] = "shutdown"


@dataclass(frozen=True, slots=True)
class DeferredAction:
    """Only code of the description knows what is done: the resolver, which knows `ref`, is asked when it happens."""

    ref: int
    location: Location
    action: Literal["deferred"] = "deferred"


TriggeredAction: TypeAlias = (
    LogAction
    | StartAction
    | LoadAction
    | StopAction
    | SignalAction
    | ChangeStateAction
    | RegisterAction
    | UnregisterAction
    | CancelAction
    | ShutdownAction
    | DeferredAction
)


@dataclass(frozen=True, slots=True)
class Trigger:
    """Actions to carry out `delay` seconds after an event.

    `id` is unique in the plan. `armed`: it waits for its event from the start of the run on, else when a
    `RegisterAction` says so. `once`: it is set off once at most. `cancel_on_shutdown`: a delay that is running when
    the run ends is dropped. `deferred` tells that one of `do` is.
    """

    id: str
    on: TriggerEvent
    do: tuple[TriggeredAction, ...]
    delay: float | None
    deferred: bool
    location: Location
    armed: bool = True
    once: bool = False
    cancel_on_shutdown: bool = True
