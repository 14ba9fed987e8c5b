"""Plans the way of a journey: to its goal, to a place to look at, or out of the way of another robot."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

from bringup.control.costs import CLOSED, eased
from bringup.control.giving_way import (
    begun,
    finished,
    in_the_way,
    is_impatient,
    is_over,
    moved_on,
    told_apart,
)
from bringup.control.lookout import looked
from bringup.control.passing import DEAR, among, meeting
from bringup.control.route import found
from bringup.control.way import Way, dearest, remaining

if TYPE_CHECKING:
    from bringup.control.command import Pose
    from bringup.control.costs import Costs
    from bringup.control.giving_way import Giving
    from bringup.control.journey import Journey
    from bringup.control.settings import Settings

# Seconds between two plans, and while something moves nearby.
PERIOD, PERIOD_MEETING = 1.0, 0.5
# How much shorter a new way must be to be taken instead of one that is free.
SHORTER = 0.8
# A way keeps this much (m) more than the robot's radius from what is seen; tight passages are taken by it.
KEPT = 0.07
# At the goal itself it may be so much (m): the guard lets the robot as near.
LEAST = 0.03
# The share of the tolerance within which a way may end.
WITHIN = 0.8
# A way around what moves may be so much longer (m) than the one through it: else the robot waits.
DETOUR = 3.0
# A robot that has given way so often does not wait any more where there is a way around.
OFTEN = 2
# So near (m) to the place where it lets others by a robot is there; it stays where it has come in so many seconds.
AT, LONGEST = 0.15, 20.0


def planned(journey: Journey, pose: Pose, settings: Settings, now: float) -> Journey:
    """The journey with a way for the time until the next plan."""
    movers, standing = told_apart(journey.courtesy, journey.movers)
    grid, period = journey.grid, PERIOD_MEETING if movers else PERIOD
    if grid is None or now - journey.planned < period:
        return journey
    journey = replace(journey, planned=now)
    radius = settings.robot_radius + KEPT
    fixed = among(grid, standing, radius)
    direct = _way(journey, fixed, pose, settings)
    if not movers and journey.courtesy.giving is None:
        return _towards_goal(journey, fixed, direct, pose, now)
    priced = meeting(grid, movers, standing, pose, radius)
    new = _way(journey, priced, pose, settings)
    waits = direct is not None and _waits(journey, new, direct, pose)
    near = in_the_way(movers, pose)
    courtesy = moved_on(journey.courtesy, pose, now)
    if is_impatient(courtesy, near, settings.seed, now, waits=waits):
        courtesy = begun(courtesy, priced, fixed, pose, near, now)
    journey = replace(journey, courtesy=courtesy)
    if courtesy.giving is not None:
        return _giving_way(journey, courtesy.giving, priced, direct, pose, settings, now)
    if waits:
        return replace(journey, way=None if near else direct, no_way_since=None)
    return _towards_goal(journey, priced, new, pose, now)


def _way(journey: Journey, priced: Costs, pose: Pose, settings: Settings) -> Way | None:
    """The way to the goal, which may be tight at its end."""
    place, within = (journey.goal.x, journey.goal.y), journey.goal.xy_tolerance * WITHIN
    way = found(priced, pose, place, within)
    if way is not None:
        return way
    tight = eased(priced, settings.robot_radius + LEAST, place, within + KEPT)
    return None if tight is None else found(tight, pose, place, within)


def _towards_goal(journey: Journey, priced: Costs, new: Way | None, pose: Pose, now: float) -> Journey:
    """The journey on its way to the goal, or to what may be in the way."""
    if new is not None:
        # A way to a place to look at does not lead to the goal.
        old = journey.way if journey.lookout.doubt is None else None
        lookout = replace(journey.lookout, doubt=None)
        return replace(journey, way=_kept(old, new, pose), lookout=lookout, no_way_since=None)
    lookout = looked(journey.lookout, priced, pose, (journey.goal.x, journey.goal.y), now)
    if lookout.doubt is not None:
        return replace(journey, way=lookout.doubt.way, lookout=lookout, no_way_since=None)
    since = now if journey.no_way_since is None else journey.no_way_since
    return replace(journey, way=None, lookout=lookout, no_way_since=since)


def _kept(old: Way | None, new: Way, pose: Pose) -> Way:
    """The old way, if it is free, on the right of others and not much longer; the robot would waver otherwise."""
    if old is None:
        return new
    old = replace(old, costs=new.costs)
    worth = remaining(new, pose) >= SHORTER * remaining(old, pose)
    price = dearest(old, pose)
    dear = price >= DEAR and price > dearest(new, pose)
    return old if worth and price < CLOSED and not dear else new


def _waits(journey: Journey, new: Way | None, direct: Way, pose: Pose) -> bool:
    """Whether the robot waits until what moves lets it by, rather than to look for a way around."""
    if new is None:
        return True
    return journey.courtesy.times < OFTEN and remaining(new, pose) > remaining(direct, pose) + DETOUR


def _giving_way(
    journey: Journey,
    giving: Giving,
    priced: Costs,
    direct: Way | None,
    pose: Pose,
    settings: Settings,
    now: float,
) -> Journey:
    """The journey on its way to where it lets others by, or while it waits there."""
    courtesy = journey.courtesy
    movers, _ = told_apart(courtesy, journey.movers)
    if is_over(courtesy, movers, direct, pose, settings.seed, now):
        return replace(
            journey, courtesy=finished(courtesy, movers, now), way=None, no_way_since=None, planned=-math.inf
        )
    way = None
    if giving.since is None:
        way = found(priced, pose, (giving.x, giving.y), AT)
        if way is None or pose.distance(giving.x, giving.y) < AT or now - courtesy.tried > LONGEST:
            giving, way = replace(giving, since=now), None
    return replace(journey, way=way, courtesy=replace(courtesy, giving=giving), no_way_since=None)
