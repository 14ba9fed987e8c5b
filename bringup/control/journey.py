"""One goal of a robot on its way: what was seen, what is planned, how it ended."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from bringup.control.giving_way import Courtesy
from bringup.control.grid import Grid
from bringup.control.lookout import Lookout
from bringup.control.movers import Mover
from bringup.control.outcome import Result
from bringup.control.way import Way


@dataclass(frozen=True, slots=True)
class Goal:
    """A place in m of the odometry frame, and how near counts as there. Of `yaw_tolerance` 0 any heading is right.

    `timeout` is in seconds, 0 for no end.
    """

    x: float
    y: float
    yaw: float = 0.0
    xy_tolerance: float = 0.1
    yaw_tolerance: float = 0.0
    timeout: float = 0.0


@dataclass(frozen=True, slots=True)
class Progress:
    """Where the robot was when it last got on, and when."""

    x: float
    y: float
    at: float


@dataclass(frozen=True, slots=True)
class Journey:
    """One goal on its way: what was seen, what is planned, and the result once it is over."""

    goal: Goal
    since: float
    grid: Grid | None = None
    movers: tuple[Mover, ...] = ()
    seen: float = -math.inf
    way: Way | None = None
    planned: float = -math.inf
    no_way_since: float | None = None
    lookout: Lookout = field(default_factory=Lookout)
    courtesy: Courtesy = field(default_factory=Courtesy)
    arrived: float | None = None
    progress: Progress | None = None
    result: Result | None = None
    lost_since: float | None = None
    left: float = math.nan
