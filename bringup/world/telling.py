"""What the simulation tells the person who watches it: lines of log, and the same as diagnostics."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from bringup.world import messages, report
from bringup.world.model import pose

if TYPE_CHECKING:
    from rclpy.node import Node

    from bringup.world.course import Course
    from bringup.world.pace import Metronome

# A run that is later than this many real seconds, or reaches less than this share of the speed asked for, is behind.
LATE = 0.5
ENOUGH = 0.95


class Telling:
    """Status lines, the lines at the end, and `/diagnostics`."""

    def __init__(self, node: Node, course: Course) -> None:
        self._node, self._course = node, course
        self._log = node.get_logger()
        self._diagnostics = node.create_publisher(DiagnosticArray, "/diagnostics", 10)
        self._since, self._reached = time.monotonic(), course.simulation.time

    def update(self, now: float, metronome: Metronome) -> None:
        """Tell how it goes, if it is time for that."""
        passed, settings = now - self._since, self._course.settings
        if passed < settings.status_period:
            return
        reached = self._course.simulation.time
        factor = max(0.0, reached - self._reached) / passed
        self._since, self._reached = now, reached
        for line in self._lines():
            self._log.info(line)
        slow = settings.speed > 0.0 and factor < ENOUGH * settings.speed and metronome.lag > 0.0
        late = slow or metronome.lag > LATE
        if late:
            self._log.warning(report.behind(factor, settings.speed, metronome.lag, metronome.lost))
        self._publish(factor, metronome, late=late)

    def given_up(self, robot: str, seconds: float) -> None:
        """Tell that a filter has been waited for so long (real seconds) in vain."""
        self._log.warning(report.given_up(robot, seconds))

    def end(self, real: float) -> None:
        """What the run came to, after so many real seconds."""
        self._log.info(report.summary(self._course.simulation.time, real))
        for topics, count in zip(self._course.robots, self._course.simulation.contacts, strict=True):
            self._log.info(report.contacts(topics.robot.name, count.episodes))

    def _lines(self) -> list[str]:
        """One line per robot."""
        simulation, lines = self._course.simulation, []
        for topics in self._course.robots:
            error, told = topics.filter_error, "no estimate yet"
            if error is not None:
                told = report.filter_error(error.distance, error.turn, simulation.ticks - error.tick)
            here = pose(simulation.data, topics.robot)
            lines.append(report.status(topics.robot.name, here, told, topics.sensors.nearest()))
        return lines

    def _publish(self, factor: float, metronome: Metronome, *, late: bool) -> None:
        settings, simulation = self._course.settings, self._course.simulation
        values = {
            "real_time_factor": f"{factor:.3f}",
            "speed": f"{settings.speed:g}",
            "late": f"{metronome.lag:.2f} s",
            "given_up": f"{metronome.lost:.2f} s",
            "paused": str(settings.paused).lower(),
        }
        contacts = zip(self._course.robots, simulation.contacts, strict=True)
        values.update({f"{topics.robot.name}.contacts": str(count.episodes) for topics, count in contacts})
        status = DiagnosticStatus(
            level=DiagnosticStatus.WARN if late else DiagnosticStatus.OK,
            name=f"{self._node.get_fully_qualified_name()}: real time",
            message=report.behind(factor, settings.speed, metronome.lag, metronome.lost)
            if late
            else "in step",
            values=[KeyValue(key=key, value=value) for key, value in values.items()],
        )
        message = DiagnosticArray(status=[status])
        messages.stamp(message.header.stamp, simulation.ticks)
        self._diagnostics.publish(message)
