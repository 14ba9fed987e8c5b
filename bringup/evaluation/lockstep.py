"""Runs a world with filters and controllers in one process, tick by tick: no clock, no ROS graph, no chance."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bringup.evaluation.crew import ODOMETRY_TICKS, SCAN_TICKS, Member
from bringup.evaluation.innovations import Innovations
from bringup.evaluation.track import Track
from bringup.filter.state import YAW, X, Y
from bringup.world.geometry import relative
from bringup.world.layout import lay_out
from bringup.world.model import TICKS_PER_SECOND, load, pose
from bringup.world.simulation import Simulation

if TYPE_CHECKING:
    from bringup.evaluation.scenario import Scenario
    from bringup.filter.localization import Estimate

PLANAR = np.ix_((X, Y, YAW), (X, Y, YAW))


class Log:
    """The rows of one robot while it runs, ten in a second."""

    def __init__(self, member: Member) -> None:
        self.member = member
        self._innovations = Innovations()
        member.filter.observe(self._innovations)
        self._rows: list[tuple[float, ...]] = []
        self._covariances: list[np.ndarray] = []

    def note(self, simulation: Simulation, estimate: Estimate) -> None:
        """Keep this moment."""
        here = relative(self.member.robot.start, pose(simulation.data, self.member.robot))
        believed = self.member.believed
        filtered = estimate.state[[X, Y, YAW]].tolist()
        self._rows.append(
            (simulation.time, here.x, here.y, here.yaw, believed.x, believed.y, believed.yaw, *filtered)
        )
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


def run(scenario: Scenario) -> list[Track]:
    """Run a scenario; the same one gives the same numbers to the last bit."""
    world = scenario.world
    layout = lay_out(world.world, world.seed, world.robots, world.start_poses)
    simulation = Simulation(load(layout), world.limits)
    logs = [Log(Member(simulation, number, scenario)) for number in range(len(world.robots))]
    for _ in range(round(scenario.seconds * TICKS_PER_SECOND)):
        simulation.tick([log.member.command() for log in logs])
        for log in logs:
            _tick(simulation, log)
    return [log.track(count.episodes) for log, count in zip(logs, simulation.contacts, strict=True)]


def _tick(simulation: Simulation, log: Log) -> None:
    member = log.member
    member.sense()
    if simulation.ticks % ODOMETRY_TICKS:
        return
    estimate = member.fuse()
    if simulation.ticks % SCAN_TICKS:
        return
    member.look()
    member.decide()
    if estimate is not None:
        log.note(simulation, estimate)
