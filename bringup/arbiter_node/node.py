"""Topics of the command arbiter.

Subscribes the topics of its inputs (Twist or TwistStamped) and locks (std_msgs/Bool), publishes `cmd_vel`,
`/diagnostics` and, latched, `~/active`: the name of the input in force, of the lock that holds, or `none`. What the
input in force says goes on at once; while nobody is in force the robot is ordered to stand at every tick.
"""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING, Any

from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Bool, String

from bringup.arbiter.choice import NOBODY, Choice, chosen, is_locked
from bringup.arbiter_node.parameters import Parameters
from bringup.control.command import STANDSTILL
from bringup.control_node.diagnostics import ERROR, OK, WARN, Diagnostics
from bringup.control_node.messages import command_of, fill_command, twist_type

if TYPE_CHECKING:
    from bringup.arbiter.settings import Settings, Source

NEWEST = QoSProfile(depth=1)
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
FAREWELL = Duration(seconds=0.5)
UNWATCHED = PublisherEventCallbacks(use_default_callbacks=False)
UNWATCHED_INPUT = SubscriptionEventCallbacks(use_default_callbacks=False)
PERIOD = 0.05


class CommandArbiter(Node):  # type: ignore[misc] # rclpy is untyped
    """The node. Raises what `Parameters` raises."""

    def __init__(self, **options: Any) -> None:  # noqa: ANN401 - rclpy's own arguments of a node
        super().__init__("command_arbiter", **options)
        try:
            self._given = Parameters(self)
        except Exception:
            Node.destroy_node(self)  # not what a component does besides: it is not whole yet
            raise
        self._heard: dict[str, float] = {}
        self._locked: dict[str, tuple[float, bool]] = {}
        self._broken: set[str] = set()
        self._choice = Choice(None, NOBODY)
        self._kind = twist_type(self._given.use_stamped)
        self._stop = self._kind()
        self._commands = self.create_publisher(self._kind, "cmd_vel", NEWEST, event_callbacks=UNWATCHED)
        self._active = self.create_publisher(String, "~/active", LATCHED, event_callbacks=UNWATCHED)
        self._active.publish(String(data=NOBODY))
        self._diagnostics = Diagnostics(self, "commands")
        for source in self._settings.inputs:
            self.create_subscription(self._kind, source.topic, partial(self._hear, source.name), NEWEST)
        for source in self._settings.locks:
            self._listen_to_lock(source)

    @property
    def _settings(self) -> Settings:
        return self._given.settings

    def tick(self) -> None:
        """Order the robot to stand if nobody is in force; tell the state."""
        now = self._now()
        self._choose(now)
        if self._choice.input is None:
            self._send_stop()
        level, text = self._health()
        if self._diagnostics.is_due(now, level):
            self._diagnostics.tell(now, level, text, self._values(now))

    def stand_still(self, _: str) -> None:
        """Send a last order to stand still, and wait a moment until it has arrived."""
        self._send_stop()
        self._commands.wait_for_all_acked(FAREWELL)

    def _listen_to_lock(self, source: Source) -> None:
        hear = partial(self._hear_lock, source.name)
        self.create_subscription(Bool, source.topic, hear, NEWEST)
        # A lock that is latched is heard by an arbiter that was started again; one that is not gets no warning here.
        self.create_subscription(Bool, source.topic, hear, LATCHED, event_callbacks=UNWATCHED_INPUT)

    def _now(self) -> float:
        return float(self.get_clock().now().nanoseconds) * 1e-9

    def _hear(self, name: str, message: Any) -> None:  # noqa: ANN401 - Twist or TwistStamped
        command, now = command_of(message), self._now()
        if not (math.isfinite(command.linear) and math.isfinite(command.angular)):
            self._broken.add(name)
            return
        self._broken.discard(name)
        self._heard[name] = now
        self._choose(now)
        if self._choice.input is not None and self._choice.input.name == name:
            self._commands.publish(message)

    def _hear_lock(self, name: str, message: Bool) -> None:
        self._locked[name] = self._now(), message.data
        self._choose(self._now())
        if self._choice.input is None:
            self._send_stop()

    def _choose(self, now: float) -> None:
        before, self._choice = self._choice, chosen(self._settings, self._heard, self._locked, now)
        if self._choice.holder != before.holder:
            self._active.publish(String(data=self._choice.holder))
            self.get_logger().info(f"in force: {self._choice.holder}, before: {before.holder}")

    def _send_stop(self) -> None:
        fill_command(self._stop, STANDSTILL, self.get_clock().now().to_msg(), "")
        self._commands.publish(self._stop)

    def _health(self) -> tuple[bytes, str]:
        if self._broken:
            return ERROR, f"no numbers come from {', '.join(sorted(self._broken))}"
        if self._choice.input is not None:
            return OK, f"in force: {self._choice.holder}"
        if self._choice.holder == NOBODY:
            return OK, "no input is heard"
        return WARN, f"locked by {self._choice.holder}"

    def _values(self, now: float) -> dict[str, str]:
        """All sources with their priorities, and what is known of them."""
        told = {"in force": self._choice.holder}
        for source in self._settings.inputs:
            at = self._heard.get(source.name)
            age = "never heard" if at is None else f"heard {now - at:.3f} s ago"
            told[f"input {source.name}"] = f"priority {source.priority}, {age}"
        for source in self._settings.locks:
            holds = is_locked(source, self._locked.get(source.name), now)
            told[f"lock {source.name}"] = f"priority {source.priority}, {'locked' if holds else 'free'}"
        return told


class Component(CommandArbiter):
    """The same for a container: a timer makes the ticks, and unloading it makes the robot stand."""

    def __init__(self, **options: Any) -> None:  # noqa: ANN401 - rclpy's own arguments of a node
        super().__init__(**options)
        self.create_timer(PERIOD, self.tick)

    def destroy_node(self) -> None:
        """Stand still and leave the graph."""
        self.stand_still("the component was unloaded")
        super().destroy_node()
