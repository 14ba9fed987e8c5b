"""The simulation on the ROS graph, in step with real time.

It runs its own loop instead of an executor's: ticks have deadlines, messages are taken when a tick begins, and the
executor only serves the parameter services in between.
"""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING

import rclpy
from rclpy.exceptions import InvalidParameterTypeException, InvalidParameterValueException
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from rosgraph_msgs.msg import Clock

from bringup.world import messages, pace, report
from bringup.world.layout import LayoutError, lay_out
from bringup.world.model import load, pose
from bringup.world.parameters import declare
from bringup.world.settings import SettingsError
from bringup.world.simulation import TICK, Simulation
from bringup.world.topics import LATCHED, QUEUED, RobotTopics
from bringup.world.window import NoWindowError, open_window
from orchestra.ros.interfaces import tf_message_type

if TYPE_CHECKING:
    from typing import Any

    from bringup.world.stop import Stop

REFUSALS = (
    InvalidParameterTypeException,
    InvalidParameterValueException,
    LayoutError,
    NoWindowError,
    SettingsError,
)
# Real seconds between two looks at the parameter services, and between two pictures in the window.
SERVICE_PERIOD = 0.04


class World:
    """The simulation on the ROS graph.

    Raises what `declare`, `lay_out` and `open_window` raise.
    """

    def __init__(self, node: Node) -> None:
        self.node = node
        self.settings = declare(node)
        layout = lay_out(
            self.settings.world, self.settings.seed, self.settings.robots, self.settings.start_poses
        )
        self.simulation = Simulation(load(layout), self.settings.limits)
        self.window: Any = None if self.settings.headless else open_window(self.simulation)
        self.robots = [
            RobotTopics(node, self.simulation, number, self.settings)
            for number in range(len(self.settings.robots))
        ]
        self._clock_message = Clock()
        self._clock = node.create_publisher(Clock, "/clock", QUEUED)
        self._publish_mounts()

    @property
    def finished(self) -> bool:
        """Whether the run is over: its duration has passed, or its window has been closed."""
        if self.window is not None and not self.window.is_running():
            return True
        return 0.0 < self.settings.duration <= self.simulation.time

    def tick(self) -> None:
        """Advance the world by one tick and publish what is due."""
        self.simulation.tick([robot.command() for robot in self.robots])
        messages.stamp(self._clock_message.clock, self.simulation.ticks)
        self._clock.publish(self._clock_message)
        for robot in self.robots:
            robot.publish()

    def show(self) -> None:
        """Bring the window up to date, if there is one."""
        if self.window is not None:
            self.window.sync()

    def close(self) -> None:
        """Close the window, if there is one."""
        if self.window is not None:
            self.window.close()

    def log_status(self) -> None:
        """One line per robot."""
        for topics in self.robots:
            error = topics.filter_error
            told = "no estimate yet"
            if error is not None:
                told = report.filter_error(error.distance, error.turn, self.simulation.ticks - error.tick)
            here = pose(self.simulation.data, topics.robot)
            self.node.get_logger().info(report.status(topics.robot.name, here, told, topics.nearest))

    def log_end(self, real: float) -> None:
        """What the run came to, after so many real seconds; the picture, if one is wanted."""
        self.node.get_logger().info(report.summary(self.simulation.time, real))
        for topics, count in zip(self.robots, self.simulation.contacts, strict=True):
            self.node.get_logger().info(report.contacts(topics.robot.name, count.episodes))
        if self.settings.picture:
            self._write_picture(Path(self.settings.picture))

    def _write_picture(self, path: Path) -> None:
        # Here, because a run without a picture needs no Pillow.
        from bringup.world.picture import Driven, write  # noqa: PLC0415

        driven = [
            Driven(
                topics.robot.name,
                topics.robot.start,
                topics.true_trail.points,
                topics.odometry_trail.points,
                topics.filtered_trail.points,
            )
            for topics in self.robots
        ]
        try:
            write(self.simulation.model.layout, driven, path)
        except OSError as error:
            self.node.get_logger().error(f"the picture cannot be written: {error}")
        else:
            self.node.get_logger().info(f"picture written to {path}")

    def _publish_mounts(self) -> None:
        message_type = tf_message_type()
        self._mounts = self.node.create_publisher(message_type, "/tf_static", LATCHED)
        transforms = [mount for name in self.settings.robots for mount in messages.mounts(name)]
        self._mounts.publish(message_type(transforms=transforms))


def run(world: World, stop: Stop) -> None:
    """Keep the world in step with real time until it is over."""
    executor = SingleThreadedExecutor()
    executor.add_node(world.node)
    began = now = next_service = time.monotonic()
    next_status = began + world.settings.status_period
    speed = world.settings.speed
    beat = pace.Pace(began, 0.0, speed)
    while not (stop.requested or world.finished):
        beat = pace.kept(beat, now, world.simulation.time, speed)
        due = pace.wait(beat, now, world.simulation.time + TICK)
        if due > 0.0:
            time.sleep(min(due, SERVICE_PERIOD))
        else:
            world.tick()
        now = time.monotonic()
        if now >= next_service:
            next_service = now + SERVICE_PERIOD
            executor.spin_once(timeout_sec=0.0)
            world.show()
            speed = world.node.get_parameter("speed").value
        if now >= next_status:
            next_status = now + world.node.get_parameter("status_period").value
            world.log_status()
    world.log_end(now - began)
    executor.shutdown()


def serve(args: list[str] | None, stop: Stop) -> int:
    """Make the node and run it; 0 after a whole or a stopped run, 1 and a line of log if it cannot be as asked."""
    rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
    node = Node("simulation")
    try:
        world = World(node)
        run(world, stop)
        world.close()
    except REFUSALS as error:
        node.get_logger().fatal(str(error))
        return 1
    finally:
        # Without this the other participants would see the node for 20 s more.
        node.destroy_node()
        rclpy.shutdown()
    return 0
