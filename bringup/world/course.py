"""The run as it stands on the ROS graph: the world, its robots' topics, and what moves them on."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

from bringup.world import messages
from bringup.world.body import CAMERAS, FOOTPRINT_RADIUS
from bringup.world.collisions import Collisions
from bringup.world.layout import LayoutError, lay_out, room
from bringup.world.model import TICKS_PER_SECOND, Moment, load, pose
from bringup.world.own_time import OwnTime
from bringup.world.script import Script, read_script
from bringup.world.simulation import Simulation
from bringup.world.spoken import ClockOut
from bringup.world.topics import LATCHED, QUEUED, RobotTopics
from orchestra.ros.interfaces import tf_message_type

if TYPE_CHECKING:
    from concurrent.futures import Future

    from rclpy.node import Node

    from bringup.world.drive import Twist
    from bringup.world.geometry import Pose
    from bringup.world.settings import Settings


class Course:
    """The simulation on the ROS graph; everything here happens between two ticks or is one.

    Raises LayoutError and ScriptError.
    """

    def __init__(self, node: Node, settings: Settings) -> None:
        self.settings = settings
        layout = lay_out(settings.world, settings.seed, settings.robots, settings.start_poses)
        self._script = read_script(Path(settings.script), settings.robots) if settings.script else Script({})
        self.simulation = Simulation(load(layout), [each.limits for each in settings.each])
        self.robots = [
            RobotTopics(node, self.simulation, number, settings) for number in range(len(settings.robots))
        ]
        self._collisions = Collisions(node, self.simulation)
        self._clock = ClockOut(node, QUEUED)
        self._own_time = OwnTime(node)
        self._publish_mounts(node)
        self._steps: list[tuple[int, Future[int]]] = []

    @property
    def finished(self) -> bool:
        """Whether the duration of the run has passed."""
        return 0.0 < self.settings.duration <= self.simulation.time

    @property
    def moving(self) -> bool:
        """Whether time goes on: it is not paused, or a step is under way."""
        return not self.settings.paused or bool(self._steps)

    @property
    def stepping(self) -> bool:
        """Whether a step is under way: it does not wait for real time."""
        return bool(self._steps)

    @property
    def unthrottled(self) -> bool:
        """Whether ticks follow one another as fast as they can."""
        return self.settings.speed == 0.0 or self.stepping

    def lagging(self) -> list[RobotTopics]:
        """The robots whose filters an unthrottled world should wait for."""
        most = self.settings.filter_lag * TICKS_PER_SECOND
        if not most or self.settings.speed or self.stepping:
            return []
        return [robot for robot in self.robots if robot.lagging(most)]

    def apply(self, settings: Settings) -> None:
        """Go on with other settings."""
        self.settings = settings
        self.simulation.limits[:] = [each.limits for each in settings.each]
        for robot, each in zip(self.robots, settings.each, strict=True):
            robot.sensors.settings = each

    def reset(self) -> None:
        """Begin anew, at time 0."""
        self.simulation.reset()
        for robot, each in zip(self.robots, self.settings.each, strict=True):
            robot.reset(each)
        self.tell_time()

    def step(self, ticks: int, done: Future[int]) -> None:
        """Go on by so many ticks, and tell then at which tick that has ended."""
        self._steps.append((self.simulation.ticks + ticks, done))

    def teleport(self, robot: str, target: Pose) -> None:
        """Put a robot elsewhere. Raises LayoutError: there is no such robot, or no room for it."""
        if robot not in self.settings.robots:
            raise LayoutError(f"no robot is called '{robot}'; there are {', '.join(self.settings.robots)}")
        number = self.settings.robots.index(robot)
        layout = self.simulation.model.layout
        if not (math.isfinite(target.yaw) and room(layout, target.x, target.y) > FOOTPRINT_RADIUS):
            raise LayoutError(f"{robot} has no room at x {target.x:g}, y {target.y:g}, yaw {target.yaw:g}")
        for other in self.simulation.model.robots:
            here = pose(self.simulation.data, other)
            near = math.hypot(here.x - target.x, here.y - target.y) <= 2 * FOOTPRINT_RADIUS
            if other.name != robot and near:
                raise LayoutError(f"{robot} has no room there: {other.name} stands in the way")
        self.simulation.teleport(number, target)

    def tick(self, most: int = 1) -> bool:
        """Advance by a tick, or by up to `most` in a row, and then publish what is due at each of them.

        False if a command that has to come first is missing. Commands are heard before the first.
        """
        moments = self._advance(most)
        last = self.simulation.ticks
        self._own_time.set(last)
        for ticks, moment in enumerate(moments, last - len(moments) + 1):
            self._clock.publish(ticks)
            for robot in self.robots:
                robot.publish(ticks, moment)
        self._collisions.publish()
        while self._steps and self._steps[0][0] <= last:
            _, done = self._steps.pop(0)
            done.set_result(last)
        return bool(moments)

    def _advance(self, most: int) -> list[Moment]:
        """The moments of the ticks to come; the last is one at which somebody looks at the world, if there is one."""
        simulation, moments = self.simulation, list[Moment]()
        for robot in self.robots:
            robot.notice()
        if self.settings.lockstep_ticks is None:
            for robot in self.robots:
                robot.hear()
        while len(moments) < most:
            commands = self._commands()
            if commands is None:
                break
            simulation.tick(commands)
            moments.append(simulation.moment())
            if self._stays():
                break
        return moments

    def _stays(self) -> bool:
        """Whether this tick is published before the next one: something ends with it or looks at it."""
        ticks = self.simulation.ticks
        return (
            self.finished
            or bool(self._steps and self._steps[0][0] <= ticks)
            or self._collisions.changed
            or any(robot.looks(ticks) for robot in self.robots)
        )

    def tell_time(self) -> None:
        """Publish the clock as it is."""
        self._own_time.set(self.simulation.ticks)
        self._clock.publish(self.simulation.ticks)

    def _commands(self) -> list[Twist] | None:
        """What each robot obeys at the tick to come; None in lockstep while one of them waits for its command."""
        ticks, stretch = self.simulation.ticks, self.settings.lockstep_ticks
        if stretch is None:
            return [self._script.command(robot.robot.name, ticks) or robot.command() for robot in self.robots]
        # The first stretch is free: a node that follows the clock says nothing before time has begun.
        if ticks and ticks % stretch == 0 and not self._all_told():
            return None
        return [self._script.command(robot.robot.name, ticks) or robot.last_command for robot in self.robots]

    def _all_told(self) -> bool:
        """Take one command for each robot that waits for one; whether all have theirs for the stretch to come."""
        ticks = self.simulation.ticks
        for robot in self.robots:
            scripted = self._script.command(robot.robot.name, ticks) is not None
            if not scripted and robot.told_at != ticks and not robot.next_command():
                return False
        return True

    def _publish_mounts(self, node: Node) -> None:
        message_type = tf_message_type()
        self._mounts = node.create_publisher(message_type, "/tf_static", LATCHED)
        settings = self.settings
        transforms = [mount for name in settings.robots for mount in messages.mounts(name)]
        if settings.camera_rate:
            transforms += [mount for name in settings.robots for mount in messages.mounts(name, CAMERAS)]
        if settings.world_frame:
            transforms += [
                messages.odom_frame(settings.world_frame, robot.name, robot.start)
                for robot in self.simulation.model.robots
            ]
        self._mounts.publish(message_type(transforms=transforms))
