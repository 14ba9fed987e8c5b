"""Values that mean the same at every stage, as frozen data."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

Scalar: TypeAlias = bool | int | float | str
ParameterValue: TypeAlias = Scalar | tuple[bool, ...] | tuple[int, ...] | tuple[float, ...] | tuple[str, ...]
Condition: TypeAlias = Literal["started", "ready", "completed", "exited"]
Policy: TypeAlias = Literal["no", "on-failure", "always"]
Level: TypeAlias = Literal["debug", "info", "warning", "error"]
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

    Upstream's `respawn` is `always`; the delay is the least one and doubles up to `max_delay` while runs stay
    shorter than `min_uptime`.
    """

    policy: Policy
    delay: float = 0.0
    max_delay: float = 30.0
    min_uptime: float = 10.0
    budget: int | None = None


@dataclass(frozen=True, slots=True)
class Stop:
    """How a process is ended: `signal`, after `timeout` s SIGTERM, after another `kill_timeout` s SIGKILL."""

    signal: str = "SIGINT"
    timeout: float = 2.0
    kill_timeout: float = 1.5
