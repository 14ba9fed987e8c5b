"""Runs a world with filters and controllers in one process, tick by tick: no clock, no ROS graph, no chance."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bringup.evaluation.crew import Member
from bringup.evaluation.innovations import Innovations
from bringup.evaluation.track import Track
from bringup.filter.state import YAW, X, Y
from bringup.world.layout import lay_out
from bringup.world.model import TICKS_PER_SECOND, load
from bringup.world.sensing import due
from bringup.world.simulation import Simulation

if TYPE_CHECKING:
    from bringup.evaluation.scenario import Scenario
    from bringup.world.geometry import Pose
    from bringup.world.layout import Layout

PLANAR = np.ix_((X, Y, YAW), (X, Y, YAW))
# Rows of a track in a simulated second.
RATE = 10.0


class Log:
    """The rows of one robot while it runs."""

    def __init__(self, member: Member, *, innovations: bool) -> None:
        self.member = member
        self._innovations = Innovations()
        if innovations:
            member.filter.observe(self._innovations)
        self._rows: list[tuple[float, ...]] = []
        self._covariances: list[np.ndarray] = []

    def note(self, time: float, here: Pose) -> None:
        """Keep this moment; `here` is where the robot is as seen from where it started."""
        believed, estimate = self.member.believed, self.member.estimate
        if estimate is None:
            return
        filtered = estimate.state[[X, Y, YAW]].tolist()
        self._rows.append((time, here.x, here.y, here.yaw, believed.x, believed.y, believed.yaw, *filtered))
        self._covariances.append(estimate.covariance[PLANAR])

    def track(self, contacts: int) -> Track:
        """All rows."""
        rows = np.array(self._rows)
        start = self.member.robot.start
        return Track(
            robot=self.member.robot.name,
            start=(start.x, start.y, start.yaw),
            times=rows[:, 0],
            truth=rows[:, 1:4],
            wheels=rows[:, 4:7],
            filtered=rows[:, 7:10],
            covariance=np.array(self._covariances),
            nis=self._innovations.rows(),
            contacts=contacts,
        )


def laid_out(scenario: Scenario) -> Layout:
    """The world of a scenario. Raises LayoutError."""
    world = scenario.world
    return lay_out(world.world, world.seed, world.robots, world.start_poses)


def run(scenario: Scenario, *, innovations: bool = False) -> list[Track]:
    """Run a scenario; the same one gives the same numbers to the last bit. Innovations cost a fifth of the time.

    Raises LayoutError.
    """
    each = scenario.world.each
    simulation = Simulation(load(laid_out(scenario)), [robot.limits for robot in each])
    logs = [Log(Member(simulation, number, scenario), innovations=innovations) for number in range(len(each))]
    for _ in range(round(scenario.seconds * TICKS_PER_SECOND)):
        simulation.tick([log.member.command() for log in logs])
        for log in logs:
            readings = log.member.tick()
            if due(simulation.ticks, RATE):
                log.note(simulation.time, readings.local)
    return [log.track(count.episodes) for log, count in zip(logs, simulation.contacts, strict=True)]
