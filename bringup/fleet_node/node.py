"""The fleet monitor: sees all robots, tells how they are, keeps two of them from driving to the same place.

Robots are found in the graph (`bringup.fleet.discovery`). Publishes `~/summary` (bringup_interfaces/FleetSummary) and
`/diagnostics`; serves `~/claim_goal` and `~/release_goal`. It works by the machine's clock, so that it goes on telling
when the simulation's stands.
"""

from __future__ import annotations

from dataclasses import replace
from time import monotonic_ns
from typing import TYPE_CHECKING, Any, TypeAlias

from diagnostic_msgs.msg import DiagnosticArray
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

from bringup.fleet.discovery import part_of_status
from bringup.fleet.frames import Frames, Place
from bringup.fleet.robots import Complaint, Health, Limits, looked
from bringup.fleet_node import visited
from bringup.fleet_node.claiming import Claiming
from bringup.fleet_node.ears import Ears, yaw_of
from bringup.fleet_node.graph import present
from bringup.fleet_node.interfaces import FleetSummary
from bringup.fleet_node.messages import diagnostics, fleet_summary, robot_summary
from bringup.fleet_node.parameters import Parameters
from orchestra.ros.interfaces import tf_message_type

if TYPE_CHECKING:
    from bringup.fleet.discovery import Presence
    from bringup.fleet.robots import Robot

Message: TypeAlias = Any

# Seconds between two looks at the graph, and between two decisions about what has been claimed.
_LOOK, _DECIDE = 0.5, 0.1
# Seconds after which a clock that shows the same time is told to stand.
_CLOCK_STANDS = 2.0
_QUEUE = QoSProfile(depth=100)
_KEPT = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class FleetMonitor(Node):  # type: ignore[misc] # rclpy is untyped
    """The node. Takes the keywords of rclpy's Node, so that it can be a component too."""

    def __init__(self, node_name: str = "fleet_monitor", **options: Any) -> None:  # noqa: ANN401 - rclpy's own
        super().__init__(node_name, **options)
        self._chosen = Parameters(self, self._changed)
        self._frames = Frames()
        self._robots: dict[str, Robot] = {}
        self._ears: dict[str, Ears] = {}
        self._present: dict[str, Presence] = {}
        self._advanced = (0, monotonic_ns())
        self._claiming = Claiming(self, self._frames)
        self._summaries = self.create_publisher(FleetSummary, "~/summary", _LATCHED)
        self._diagnostics = self.create_publisher(DiagnosticArray, "/diagnostics", 10)
        self._told = visited.subscribe(self, DiagnosticArray, "/diagnostics", _QUEUE)
        self._static = visited.subscribe(self, tf_message_type(), "/tf_static", _KEPT)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(_LOOK, self.look, clock=steady)
        self.create_timer(_DECIDE, self.decide, clock=steady)
        self._telling = self.create_timer(1.0 / self._chosen.settings.rate, self.tell, clock=steady)

    def look(self) -> None:
        """See who is in the graph; who has come or gone is logged."""
        settings = self._chosen.settings
        watched = self._claiming.held.keys() | self._claiming.asking
        self._present = present(self, settings, watched)
        turnout = looked(self._robots, self._present, monotonic_ns(), settings.gone_after)
        self._robots = turnout.robots
        for name in turnout.come:
            self._ears[name] = Ears(self, name, settings)
            self.get_logger().info(f"{name} has come")
        for name in turnout.gone:
            self._ears.pop(name).close()
            self.get_logger().info(f"{name} has gone")
        self._claiming.end({name: robot.presence for name, robot in self._robots.items()})

    def decide(self) -> None:
        """Answer what has been claimed since the last time."""
        self._claiming.listen(monotonic_ns())
        if not self._claiming.asking:
            return
        self._hear_frames()
        # Who asks may have come, or started again, since the last look.
        self.look()
        self._claiming.answer(self._present, self._chosen.settings.claim_distance, monotonic_ns())

    def tell(self) -> None:
        """Publish how all robots are."""
        now, steady = int(self.get_clock().now().nanoseconds), monotonic_ns()
        settings = self._chosen.settings
        self._hear_frames()
        self._robots = {name: self._ears[name].heard(robot, now) for name, robot in self._robots.items()}
        self._hear_diagnostics(steady)
        limits = Limits(settings.stale_after, controlled=bool(settings.controller))
        summaries = [
            robot_summary(robot, self._claiming.goal(name), self._frames, (now, steady), limits)
            for name, robot in self._robots.items()
        ]
        self._summaries.publish(fleet_summary(summaries, now))
        own = self.get_fully_qualified_name()
        self._diagnostics.publish(diagnostics(own, summaries, self._doubts(now, steady), now))

    def _doubts(self, now: int, steady: int) -> list[str]:
        if now != self._advanced[0]:
            self._advanced = now, steady
        stands = (steady - self._advanced[1]) * 1e-9
        return [f"the clock stands for {stands:.1f} s"] if stands > _CLOCK_STANDS else []

    def _hear_frames(self) -> None:
        for message in visited.messages(self._static):
            for each in message.transforms:
                shift = each.transform.translation
                parent = Place(
                    each.header.frame_id.lstrip("/"), shift.x, shift.y, yaw_of(each.transform.rotation)
                )
                self._frames.put(each.child_frame_id.lstrip("/"), parent)

    def _hear_diagnostics(self, steady: int) -> None:
        for message in visited.messages(self._told):
            for status in message.status:
                about = part_of_status(status.name, status.hardware_id, self._robots)
                if about is not None:
                    robot = self._robots[about[0]]
                    complaint = Complaint(_level(status.level), status.message, steady)
                    self._robots[about[0]] = replace(robot, told={**robot.told, about[1]: complaint})

    def _changed(self) -> None:
        self._telling.timer_period_ns = round(1e9 / self._chosen.settings.rate)


def _level(value: bytes) -> Health:
    return Health(min(value[0], Health.STALE))
