"""What has been seen of a running system, and what is found in it. Times in seconds; of stamps, since the epoch."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.ros.tools.graph.system import System


@dataclass(frozen=True, slots=True)
class Tick:
    """A message on /clock: when it was sent by the clock of the machine, and the time that it gives."""

    sent: float
    time: float


@dataclass(frozen=True, slots=True)
class Heard:
    """A transform as it was published: `sent` by the clock of the machine, `stamp` is the time it is for."""

    parent: str
    child: str
    static: bool
    stamp: float
    sent: float


@dataclass(frozen=True, slots=True)
class Member:
    """A node of a run of Orchestra, with the variables that decide with whom it talks, and how."""

    run: str
    node: str
    settings: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class Observed:
    """All that the checks look at.

    `sim_time` says of each node that answered whether it takes its time from /clock, `silent` are those that did not
    answer. `until` is the end of listening by the clock of the machine, which was `set_by` so much meanwhile.
    """

    system: System
    sim_time: Mapping[str, bool] = field(default_factory=dict)
    silent: tuple[str, ...] = ()
    ticks: tuple[Tick, ...] = ()
    transforms: tuple[Heard, ...] = ()
    until: float = 0.0
    set_by: float = 0.0
    members: tuple[Member, ...] = ()


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing that is wrong: `about` names what it concerns, `details` are its facts for programs."""

    check: str
    message: str
    about: tuple[str, ...]
    details: dict[str, Any] = field(default_factory=dict)
