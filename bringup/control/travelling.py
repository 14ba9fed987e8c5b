"""Going to a goal: looks about, plans a way, follows it, and tells how it ended.

A way that is only local (towards the goal, sliding along what is in between) was considered and left out: it
is trapped by the first dead end of a maze. So the scans of a journey fill a grid, and the way is planned in it
once a second; cells that were never seen count as free, so that the robot looks there. If there is no way, the
grid may be wrong about what was seen from afar or has moved since: the robot looks there again (`lookout`).
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from bringup.control.command import STANDSTILL, Command, wrapped
from bringup.control.giving_way import Courtesy, is_waiting
from bringup.control.grid import about, marked
from bringup.control.journey import Journey, Progress
from bringup.control.lookout import is_looking
from bringup.control.movers import followed, without
from bringup.control.outcome import Outcome, Result
from bringup.control.planning import WITHIN, planned
from bringup.control.ramp import stoppable_speed
from bringup.control.way import PASSED, Way, advanced, remaining

if TYPE_CHECKING:
    from bringup.control.command import Pose
    from bringup.control.settings import Settings
    from bringup.control.sight import Sight

# What the guard keeps instead of its own distances, each in m: before an obstacle, until it drives on, and beside.
CLOSEST, HYSTERESIS, BESIDE = 0.06, 0.02, 0.04
# Seconds for which there must be no way, and nothing more to look at, before the goal is given up.
PATIENCE = 10.0
# A robot that has not come this far (m) from where it was has made no progress.
PROGRESS = 0.3
# Seconds without progress after which the robot will come no nearer to a place that it is at.
NO_NEARER = 5.0
# The share of a tolerance at which the robot stops at first.
WELL_WITHIN = 0.5
# The bearing from which on it turns on the spot, and the gain of turns (1/s).
ASIDE = 0.6
GAIN = 2.0
# Slower than this (m/s, rad/s) is standing.
STANDING = Command(0.02, 0.05)
# Slowest way to the goal in m/s and turn to its heading in rad/s: a speed that falls to 0 would never arrive.
SLOWEST = Command(0.05, 0.1)
# From a decision to the wheels, in seconds: one period of the loop and the lag of the drive.
REACTION = 0.2


def close_by(settings: Settings) -> Settings:
    """The limits of the guard for a robot that follows a planned way: it may come nearer to things beside it."""
    return replace(
        settings,
        obstacle_distance=min(settings.obstacle_distance, settings.robot_radius + CLOSEST),
        obstacle_hysteresis=min(settings.obstacle_hysteresis, HYSTERESIS),
        side_clearance=min(settings.side_clearance, BESIDE),
    )


def travelled(
    journey: Journey, pose: Pose, sight: Sight, settings: Settings, now: float, last: Command
) -> tuple[Journey, Command]:
    """One tick: the journey after it and the velocity wanted, not yet guarded; `last` is the command before."""
    if now < max(journey.since, journey.planned):
        journey = _set_back(journey, now)
    journey = replace(journey, lost_since=None)
    journey = _watched(_seen(journey, sight, settings), pose, now)
    result = _over(journey, settings, now)
    if result is not None:
        return replace(journey, result=result), STANDSTILL
    if _is_there(journey, pose, now):
        return _turned(replace(journey, left=_distance(journey, pose)), pose, settings, last)
    journey = planned(replace(journey, arrived=None), pose, settings, now)
    if journey.way is None or is_looking(journey.lookout):
        return replace(journey, left=_distance(journey, pose)), STANDSTILL
    return _followed(journey, journey.way, pose, settings)


def _set_back(journey: Journey, now: float) -> Journey:
    """The journey after the clock was set back: what happened before is as old as it is now; nobody waits for it."""
    courtesy = Courtesy(journey.courtesy.times, parked=journey.courtesy.parked)
    lookout = replace(journey.lookout, doubt=None)
    past = Journey(journey.goal, now, journey.grid, seen=now, lookout=lookout, courtesy=courtesy)
    return replace(past, arrived=None if journey.arrived is None else now)


def _distance(journey: Journey, pose: Pose) -> float:
    return pose.distance(journey.goal.x, journey.goal.y)


def _seen(journey: Journey, sight: Sight, settings: Settings) -> Journey:
    """The journey with a scan in its grid, each only once. A scan tells nothing if nobody knows where it was taken."""
    if sight.pose is None or sight.at <= journey.seen:
        return journey
    grid = journey.grid
    if grid is None:
        ends = np.array([[sight.pose.x, sight.pose.y], [journey.goal.x, journey.goal.y]])
        grid = about(ends, settings.map_resolution)
    movers = followed(journey.movers, grid, sight.pose, sight.points, sight.at)
    grid = without(marked(grid, sight.pose, sight.points, sight.clear), movers, journey.movers)
    return replace(journey, grid=grid, movers=movers, seen=sight.at)


def _watched(journey: Journey, pose: Pose, now: float) -> Journey:
    """The journey with its progress. To arrive is some as well: from there on the robot has time to turn.

    A robot that stands to look, or as there is no way, has times of its own.
    """
    last, arrives = journey.progress, _is_there(journey, pose, now)
    begins = arrives and journey.arrived is None
    stands = is_looking(journey.lookout) or is_waiting(journey.courtesy) or journey.no_way_since is not None
    if last is None or begins or stands or pose.distance(last.x, last.y) >= PROGRESS:
        journey = replace(journey, progress=Progress(pose.x, pose.y, now))
    return replace(journey, arrived=now) if begins else journey


def _over(journey: Journey, settings: Settings, now: float) -> Result | None:
    """Why the goal is given up, or None."""
    last = journey.progress
    if 0.0 < journey.goal.timeout < now - journey.since:
        return Result(Outcome.UNREACHABLE, f"not reached within {journey.goal.timeout:g} s")
    if journey.no_way_since is not None and now - journey.no_way_since > PATIENCE:
        return Result(Outcome.UNREACHABLE, "no way leads there")
    if last is not None and now - last.at > settings.progress_timeout:
        return Result(Outcome.UNREACHABLE, f"no progress within {settings.progress_timeout:g} s")
    return None


def _is_there(journey: Journey, pose: Pose, now: float) -> bool:
    """Whether the robot is at the place: well within the tolerance at first, and then as long as it is within it.

    Where it comes no nearer, because the place is tight, to be within it is enough.
    """
    left, most = _distance(journey, pose), journey.goal.xy_tolerance
    way, last = journey.way, journey.progress
    comes_no_nearer = last is not None and now - last.at > NO_NEARER
    if (comes_no_nearer or journey.no_way_since is not None) and left <= most * WITHIN:
        return True
    at_the_end = way is not None and remaining(way, pose) < PASSED
    return left <= (most if at_the_end or journey.arrived is not None else most * WELL_WITHIN)


def _turned(journey: Journey, pose: Pose, settings: Settings, last: Command) -> tuple[Journey, Command]:
    """At the place: turns to the heading, if one is asked for, and is done when it stands."""
    goal = journey.goal
    aside = wrapped(goal.yaw - pose.yaw)
    turns = abs(last.angular) > STANDING.angular
    if goal.yaw_tolerance > 0.0 and abs(aside) > goal.yaw_tolerance * (WELL_WITHIN if turns else 1.0):
        return journey, Command(0.0, math.copysign(max(abs(_turn(aside, settings)), SLOWEST.angular), aside))
    if turns or abs(last.linear) > STANDING.linear:
        return journey, STANDSTILL
    return replace(
        journey, result=Result(Outcome.REACHED, f"reached within {journey.left:.3f} m")
    ), STANDSTILL


def _followed(journey: Journey, way: Way, pose: Pose, settings: Settings) -> tuple[Journey, Command]:
    """Towards the farthest corner that can be seen, and slower before the end."""
    way = advanced(way, pose)
    left = remaining(way, pose)
    bearing = pose.bearing(*way.corners[0])
    braking = stoppable_speed(left, settings.max_linear_deceleration, REACTION)
    speed = min(settings.max_linear_vel, max(braking, SLOWEST.linear)) * max(0.0, 1.0 - abs(bearing) / ASIDE)
    return replace(journey, way=way, left=left), Command(speed, _turn(bearing, settings))


def _turn(bearing: float, settings: Settings) -> float:
    return max(-settings.max_angular_vel, min(settings.max_angular_vel, GAIN * bearing))
