"""What a process goes through, as data: its phases, what may happen to it, and what is done about it."""

from __future__ import annotations

from enum import StrEnum
from typing import TypeAlias

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.supervise.process.ending import Ending
from orchestra.values import Restart, Stop


class Phase(StrEnum):
    """Where a process is in its life."""

    WAITING = "waiting"
    STARTING = "starting"
    RUNNING = "running"
    READY = "ready"
    STOPPING = "stopping"
    RESTARTING = "restarting"
    EXITED = "exited"
    FAILED = "failed"
    SKIPPED = "skipped"


FINAL = frozenset({Phase.EXITED, Phase.FAILED, Phase.SKIPPED})
LIVE = frozenset({Phase.STARTING, Phase.RUNNING, Phase.READY, Phase.STOPPING})

# The steps by which a process is ended; a managed lifecycle node is deactivated before the first signal.
QUIESCE, POLITE, TERMINATE, KILL = -1, 0, 1, 2
# How long a managed lifecycle node may take to deactivate before it is ended, in seconds, unless it is given longer.
QUIESCE_WITHIN = 1.5


@dataclass(frozen=True, slots=True)
class Rules:
    """What the plan says about the life of a process. `ready_timeout` in seconds, None for ever.

    `guarded`: it has to give signs of life once it is ready, and gets SIGABRT first where it hangs and `aborts` says
    so. `managed`: nodes in it may have been brought to active, and leave that state before it is ended, within so many
    seconds (`quiesce_within`).
    """

    restart: Restart | None = None
    stop: Stop = field(default_factory=Stop)
    success: frozenset[int] = frozenset({0})
    awaits_ready: bool = False
    ready_timeout: float | None = None
    guarded: bool = False
    aborts: bool = False
    managed: bool = False
    quiesce_within: float = QUIESCE_WITHIN


@dataclass(frozen=True, slots=True)
class State:
    """Where a process is.

    `rung` is the step of the stop ladder that it has reached while stopping. `asked` says that somebody wanted it to
    end; `unasked` that it ended before anybody did. `again` says that it is being ended only to start anew, `hang` what
    sign of life it has not given where it is ended for that. `halted`: an operator has ended it, or kept it from
    starting, and may start it later. `ending` is how its latest run ended. `short_runs` counts runs in a row that were
    shorter than `min_uptime`.
    """

    phase: Phase = Phase.WAITING
    starts: int = 0
    been_ready: bool = False
    started_at: float = 0.0
    short_runs: int = 0
    rung: int = POLITE
    asked: bool = False
    unasked: bool = False
    again: bool = False
    hang: str | None = None
    halted: bool = False
    ending: Ending | None = None


@dataclass(frozen=True, slots=True)
class Start:
    """Begin now: nothing is waited for any more, neither others nor a pause; whatever has ended begins anew."""


@dataclass(frozen=True, slots=True)
class Skip:
    """Never begin: what it waits for will not come."""


@dataclass(frozen=True, slots=True)
class Started:
    """The program runs since `now`."""

    now: float


@dataclass(frozen=True, slots=True)
class Unstartable:
    """The program could not be started."""

    ending: Ending
    now: float


@dataclass(frozen=True, slots=True)
class Satisfied:
    """Its readiness condition holds."""


@dataclass(frozen=True, slots=True)
class ReadyExpired:
    """The time for its readiness condition is over."""


@dataclass(frozen=True, slots=True)
class Ended:
    """The program has ended; `remains` says that something it started has not."""

    ending: Ending
    remains: bool
    now: float


@dataclass(frozen=True, slots=True)
class Gone:
    """Nothing is left of it any more."""

    now: float


@dataclass(frozen=True, slots=True)
class StopAhead:
    """The run is ending, and its own turn comes later: its end is asked for from now on."""


@dataclass(frozen=True, slots=True)
class StopRequested:
    """It is to end."""


@dataclass(frozen=True, slots=True)
class Halt:
    """An operator wants it to end, or never to begin; the run goes on, and it may be started again."""


@dataclass(frozen=True, slots=True)
class Renew:
    """An operator wants it to end and to start anew; what does not run starts."""


@dataclass(frozen=True, slots=True)
class Hung:
    """It has not given a sign of life; `reason` says which."""

    reason: str


@dataclass(frozen=True, slots=True)
class Escalated:
    """It is to end with at least this step of the ladder."""

    rung: int


@dataclass(frozen=True, slots=True)
class RungExpired:
    """The time of a step of the ladder is over."""

    rung: int


@dataclass(frozen=True, slots=True)
class DelayOver:
    """The pause before a restart is over."""


Event: TypeAlias = (
    Start | Skip | Started | Unstartable | Satisfied | ReadyExpired | Ended | Gone
    | StopAhead | StopRequested | Halt | Renew | Hung | Escalated | RungExpired | DelayOver
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class Spawn:
    """Start the program."""


@dataclass(frozen=True, slots=True)
class Watch:
    """Look out for its readiness; give up after `timeout` seconds, None for never."""

    timeout: float | None


@dataclass(frozen=True, slots=True)
class Unwatch:
    """Look out no longer."""


@dataclass(frozen=True, slots=True)
class Guard:
    """Expect its signs of life from now on."""


@dataclass(frozen=True, slots=True)
class Unguard:
    """Expect no sign of life any more."""


@dataclass(frozen=True, slots=True)
class Quiesce:
    """Deactivate it; after `timeout` seconds at the latest this step is over."""

    timeout: float


@dataclass(frozen=True, slots=True)
class Send:
    """Send a signal to all of it; after `timeout` seconds this step is over, None for the last one."""

    signal: str
    rung: int
    timeout: float | None


@dataclass(frozen=True, slots=True)
class Pause:
    """Wait `delay` seconds before the next start, and at random up to the share `jitter` of it longer."""

    delay: float
    jitter: float = 0.0


@dataclass(frozen=True, slots=True)
class Settle:
    """Forget what was still to come of this run: the steps of the ladder, or the pause."""


@dataclass(frozen=True, slots=True)
class Missed:
    """Tell that it was not ready in time."""


Effect: TypeAlias = (
    Spawn | Watch | Unwatch | Guard | Unguard | Quiesce | Send | Pause | Settle | Missed
)  # fmt: skip
