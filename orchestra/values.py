"""Values that mean the same at every stage, as frozen data."""

from __future__ import annotations

from typing import Literal, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.fields import field

Scalar: TypeAlias = bool | int | float | str
ParameterValue: TypeAlias = Scalar | tuple[bool, ...] | tuple[int, ...] | tuple[float, ...] | tuple[str, ...]
Condition: TypeAlias = Literal["started", "ready", "completed", "exited"]
Policy: TypeAlias = Literal["no", "on-failure", "always"]
Level: TypeAlias = Literal["debug", "info", "warning", "error"]
# Scheduling policies of Linux (sched(7)); `fifo` and `rr` are the real-time ones.
Scheduler: TypeAlias = Literal["other", "batch", "idle", "fifo", "rr"]
# What may happen in a run; `orchestra.plan.reactions.TriggerEvent` says what each is.
EventName: TypeAlias = Literal[
    "run_started",
    "process_started",
    "process_exited",
    "process_completed",
    "process_output",
    "state_changed",
    "shutdown",
]


@dataclass(frozen=True, slots=True)
class Restart:
    """When an ended process starts again. Delays in seconds; `budget` None is without end.

    Upstream's `respawn` is `always`; the delay is the least one and grows, by the factor `growth`, up to `max_delay`
    while runs stay shorter than `min_uptime`. Up to the share `jitter` of a delay is added at random, so that what
    failed together does not come back together. `budget` counts restarts after short runs in a row.
    """

    policy: Policy
    delay: float = 0.0
    max_delay: float = 30.0
    min_uptime: float = 10.0
    budget: int | None = None
    growth: float = 2.0
    jitter: float = 0.0


@dataclass(frozen=True, slots=True)
class Stop:
    """How a process is ended: `signal`, after `timeout` s SIGTERM, after another `kill_timeout` s SIGKILL."""

    signal: str = "SIGINT"
    timeout: float = 2.0
    kill_timeout: float = 1.5


@dataclass(frozen=True, slots=True)
class Limits:
    """What a process may use, and where it runs; None leaves as it is what the process inherits.

    `cores` are numbers of logical CPUs; `exclusive` ones no other process of the run is given. `nice` from -20 to 19.
    `priority` from 1 to 99 goes with the schedulers `fifo` and `rr`. `memory` is a cap in bytes for the process and all
    it starts (cgroup). `rlimits` maps names of getrlimit(2) in small letters without RLIMIT_ (`nofile`, `core`,
    `memlock`) to soft and hard limit, -1 for none at all.
    """

    cores: tuple[int, ...] | None = None
    exclusive: bool = False
    nice: int | None = None
    scheduler: Scheduler | None = None
    priority: int | None = None
    memory: int | None = None
    rlimits: dict[str, tuple[int, ...]] = field(default_factory=dict)
