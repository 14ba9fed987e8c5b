"""`teleop`: the keys drive a robot."""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING, Any, Final

from rclpy.duration import Duration
from rclpy.qos import QoSProfile

from orchestra.errors import RunError
from orchestra.fields import replace
from orchestra.ros.tools.driving import LEGEND, STOPPED, Driving
from orchestra.ros.tools.graph.joining import joined
from orchestra.ros.tools.graph.names import absolute, topics
from orchestra.ros.tools.keyboard import keyboard
from orchestra.ros.tools.messages.types import message_class
from orchestra.ros.tools.telling import as_json, json_line

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.ros.tools.graph.joining import Graph
    from orchestra.ros.tools.keyboard import Keyboard

_TWIST: Final = "geometry_msgs/msg/Twist"
_STAMPED: Final = "geometry_msgs/msg/TwistStamped"
_TYPES: Final = (_TWIST, _STAMPED)
# How soon a key is heard, in seconds.
_HEAR: Final = 0.02
_ACKNOWLEDGED: Final = 1.0
_STOPS, _BETWEEN = 3, 0.1
_NEVER: Final = float("inf")


def teleop(options: Namespace) -> int:
    """Publish commands as the keys say, until Ctrl-C or the end of what is typed; then a stop."""
    topic = absolute("/".join(filter(None, (options.namespace.strip("/"), options.topic))))
    if options.topic.startswith("/"):
        topic = options.topic
    with joined(options) as graph, keyboard() as keys:
        seat = _Seat(graph, topic, _type(graph, topic, options), options)
        try:
            seat.drive(keys)
        finally:
            seat.stop()
    return 0


def _type(graph: Graph, topic: str, options: Namespace) -> str:
    """Return the type of the commands: what is asked for, else the one that the topic has already."""
    if options.stamped:
        return _STAMPED
    known = graph.whole(lambda: dict(topics(graph)).get(topic, []))
    if known and not set(known) & set(_TYPES):
        raise RunError(f"{topic} is of type {', '.join(known)}, which no keys drive")
    return _STAMPED if known == [_STAMPED] else _TWIST


class _Seat:
    """A publisher of commands, and what is being commanded."""

    def __init__(self, graph: Graph, topic: str, kind: str, options: Namespace) -> None:
        self._graph = graph
        self._options = options
        self._stamped = kind == _STAMPED
        self._kind = message_class(kind)
        self._publisher = graph.node.create_publisher(self._kind, topic, QoSProfile(depth=10))
        limits = (options.max_speed, options.max_turn)
        self._driving = Driving(options.speed, options.turn, limits)
        self._say(LEGEND)
        self._say(f"{kind} on {topic}\n")
        self._tell()

    def drive(self, keys: Keyboard) -> None:
        """Publish at the rate, and at once where a key is pressed, until nothing more can be typed."""
        period = 1 / self._options.rate
        due, pressed = _NEVER, time.monotonic()  # until a key is pressed, others may drive
        while not keys.ended:
            now = time.monotonic()
            for key in keys.pressed():
                pressed = now
                self._take(self._driving.pressed(key))
                due = now
            timeout = self._options.key_timeout
            if timeout is not None and now - pressed > timeout and self._driving.direction != STOPPED:
                self._take(replace(self._driving, direction=STOPPED))
                due = now
            if now >= due:
                self._publish()
                due = max(due + period, now)
            self._graph.pause(min(_HEAR, max(due - time.monotonic(), 0.0)))

    def stop(self) -> None:
        """Command a stop, and wait until it has arrived.

        Nobody tells of a subscription with best effort whether it has, so it is said again a few times.
        """
        self._take(replace(self._driving, direction=STOPPED))
        for _ in range(_STOPS):
            self._publish()
            self._publisher.wait_for_all_acked(Duration(seconds=_ACKNOWLEDGED))
            time.sleep(_BETWEEN)

    def _take(self, driving: Driving) -> None:
        if driving != self._driving:
            self._driving = driving
            self._tell()

    def _publish(self) -> None:
        made = self._kind()
        twist: Any = made.twist if self._stamped else made
        twist.linear.x, twist.linear.y, twist.linear.z, twist.angular.z = map(float, self._driving.command)
        if self._stamped:
            made.header.stamp = self._graph.node.get_clock().now().to_msg()
            made.header.frame_id = self._options.frame_id
        self._publisher.publish(made)

    def _tell(self) -> None:
        driving = self._driving
        x, y, z, turn = (round(part, 6) + 0.0 for part in driving.command)
        if as_json(self._options):
            command = {"x": x, "y": y, "z": z, "turn": turn}
            sys.stdout.write(json_line({"speed": driving.speed, "turn": driving.turn, "command": command}))
        else:
            sideways = f" y {y:.2f} z {z:.2f}" if y or z else ""
            sys.stdout.write(
                f"speed {driving.speed:.2f} m/s, turn {driving.turn:.2f} rad/s: "
                f"{x:.2f} m/s{sideways}, {turn:.2f} rad/s\n"
            )
        sys.stdout.flush()

    def _say(self, text: str) -> None:
        if not as_json(self._options):
            sys.stdout.write(text)
            sys.stdout.flush()
