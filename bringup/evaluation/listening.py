"""The recorder's node: hears truth, wheel odometry, filter and contacts of the robots, and writes them down.

Parameters: `file`, where to; `robots`, whose namespaces (empty: of everybody who publishes `odometry/filtered`);
`simulation`, the node that is asked for its world ("" for none: a real robot has no map).
"""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from nav_msgs.msg import Odometry
from rcl_interfaces.srv import GetParameters
from rclpy.clock import Clock, ClockType
from rclpy.parameter import Parameter, parameter_value_to_python
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import UInt32

from bringup.beginning import tell_unknown
from bringup.evaluation.ground import facts
from bringup.evaluation.recording import CONTACTS, FILTERED, TRUTH, WHEELS, Writer
from bringup.world import robots_file
from bringup.world.geometry import yaw_of
from bringup.world.layout import LayoutError, lay_out
from bringup.world.settings import TABLE, SettingsError, settings

if TYPE_CHECKING:
    from collections.abc import Mapping

    from rclpy.node import Node

TOPICS = {"ground_truth": TRUTH, "wheel/odometry": WHEELS, "odometry/filtered": FILTERED}
FOUND_BY = "/odometry/filtered"
# Whatever the publishers promise; deep enough for a burst.
HEARD = QoSProfile(depth=200, reliability=ReliabilityPolicy.BEST_EFFORT)
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
# Real seconds between two blocks of the file, and two looks for robots.
PERIOD = 1.0
NANOSECONDS = 10**9
RATE = 10
# What a simulation is asked for. One without start poses answers nothing at all where they are asked for with others.
WORLD = (("world", "seed", "robots", "robots_file"), ("start_poses",))
# The upper half of the covariance over (x, y, yaw) in a message's 6 x 6 one.
UPPER = (0, 1, 5, 7, 11, 35)


class Recorder:
    """Writes what it hears until it is closed. Raises OSError if the file cannot be made."""

    def __init__(self, node: Node) -> None:
        self._node = node
        path = Path(node.declare_parameter("file", "run.recording").value)
        given = node.declare_parameter("robots", Parameter.Type.STRING_ARRAY).value or ()
        self._given = [robot.strip("/") for robot in given if robot]
        simulation = str(node.declare_parameter("simulation", "/simulation").value)
        tell_unknown(node, ("file", "robots", "simulation"))
        self._robots: list[str] = []
        self._newest: dict[tuple[int, int], int] = {}
        self._writer = Writer(path)
        self._client = (
            node.create_client(GetParameters, f"{simulation.rstrip('/')}/get_parameters")
            if simulation
            else None
        )
        self._asked: list[Any] = []
        self._has_map = False
        self._look()
        # Simulated time may stand still; what has been heard is written all the same.
        node.create_timer(PERIOD, self._keep, clock=Clock(clock_type=ClockType.STEADY_TIME))
        node.get_logger().info(f"recording to {path}")

    def close(self) -> None:
        """Write the rest."""
        self._writer.close()

    def _keep(self) -> None:
        self._look()
        self._ask()
        self._writer.flush()

    def _look(self) -> None:
        """Hear the robots that are new."""
        names = self._given or sorted(
            topic.removesuffix(FOUND_BY).lstrip("/")
            for topic, types in self._node.get_topic_names_and_types()
            if topic.endswith(FOUND_BY) and "nav_msgs/msg/Odometry" in types
        )
        new = [name for name in names if name not in self._robots]
        for name in new:
            self._robots.append(name)
            self._hear(len(self._robots) - 1, name)
        if new:
            self._writer.tell({"robots": self._robots})
            self._node.get_logger().info(f"hearing {', '.join(new)}")

    def _hear(self, number: int, robot: str) -> None:
        for topic, kind in TOPICS.items():
            self._node.create_subscription(
                Odometry, f"/{robot}/{topic}", partial(self._take, kind, number), HEARD
            )
        self._node.create_subscription(UInt32, f"/{robot}/contacts", partial(self._count, number), LATCHED)

    def _take(self, kind: int, number: int, message: Any) -> None:  # noqa: ANN401 - message classes have no types
        place, turn = message.pose.pose.position, message.pose.pose.orientation
        stamp = message.header.stamp.sec * NANOSECONDS + message.header.stamp.nanosec
        if not self._wanted(kind, number, stamp):
            return
        pose = (place.x, place.y, yaw_of(turn.w, turn.x, turn.y, turn.z))
        spread = [message.pose.covariance[entry] for entry in UPPER] if kind == FILTERED else []
        self._writer.add(kind, number, stamp, (*pose, *spread))

    def _wanted(self, kind: int, number: int, stamp: int) -> bool:
        """Whether a row is to be kept: of wheels and filter the first in each tenth of a second, of the truth all."""
        newest = self._newest.get((kind, number), 0)
        if stamp < newest - NANOSECONDS:
            self._begin_afresh()
            newest = 0
        self._newest[kind, number] = max(stamp, newest)
        return kind == TRUTH or newest == 0 or stamp * RATE // NANOSECONDS > newest * RATE // NANOSECONDS

    def _begin_afresh(self) -> None:
        """Time has gone back: the simulation was reset or started again, and so is the recording."""
        self._newest.clear()
        self._writer.begin_afresh()
        self._node.get_logger().info("time has gone back: the recording begins afresh")

    def _count(self, number: int, message: Any) -> None:  # noqa: ANN401 - message classes have no types
        now = self._node.get_clock().now().nanoseconds
        self._writer.add(CONTACTS, number, now, (float(message.data),))

    def _ask(self) -> None:
        """Ask the simulation for its world, once it is there, and write down what it answers."""
        if self._client is None or self._has_map or not self._client.service_is_ready():
            return
        if not self._asked:
            self._asked = [
                self._client.call_async(GetParameters.Request(names=list(names))) for names in WORLD
            ]
        elif all(future.done() for future in self._asked):
            self._has_map = True
            self._tell_map()

    def _tell_map(self) -> None:
        told: dict[str, Any] = {}
        for names, future in zip(WORLD, self._asked, strict=True):
            told.update(zip(names, map(parameter_value_to_python, future.result().values), strict=False))
        try:
            self._writer.tell(world_of(told))
        except (KeyError, LayoutError, SettingsError) as error:
            self._node.get_logger().warning(f"the recording has no map: {error}")


def world_of(parameters: Mapping[str, Any]) -> dict[str, Any]:
    """The map of a simulation's world, from its parameters. Raises LayoutError, SettingsError, KeyError."""
    defaults = {setting.name: setting.default for setting in TABLE}
    file = parameters["robots_file"]
    described = robots_file.read(Path(file)) if file else ()
    made = settings({**defaults, **parameters}, described)
    return facts(lay_out(made.world, made.seed, made.robots, made.start_poses))
