"""Subscribes what the filter takes in: sensors, transforms, set poses and velocity commands."""

from collections.abc import Callable
from functools import partial

from geometry_msgs.msg import PoseWithCovarianceStamped, Twist, TwistStamped
from rclpy.callback_groups import CallbackGroup
from rclpy.node import Node
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    QoSProfile,
    ReliabilityPolicy,
)

from bringup.filter.localization import Localization
from bringup.filter.readings import Heard, stamp_of, velocity_command
from bringup.filter.settings import Control, Settings
from bringup.filter_node import quiet
from bringup.filter_node.messages import Message
from bringup.filter_node.throttle import Throttle
from bringup.filter_node.visits import Subscription, VisitedSubscriptions
from bringup.filter_node.wire import MESSAGE_TYPES, edges, reader, transforms
from orchestra.ros.interfaces import tf_message_type

_QUEUE = 10
_SECONDS_BETWEEN_COMPLAINTS = 5.0
_TRANSFORM_QUEUE = 100


class Inputs:
    """The subscriptions of one filter."""

    def __init__(
        self,
        node: Node,
        settings: Settings,
        localization: Localization,
        now: Callable[[], int],
        place: Callable[[Message], None],
    ) -> None:
        self._node = node
        self._localization = localization
        self._now = now
        self._frames = settings.frames
        self._visited = VisitedSubscriptions(node)
        self._visited_at = 0
        self._wrong_frame = Throttle(_SECONDS_BETWEEN_COMPLAINTS)
        self._moving: Subscription | None = None
        for sensor in settings.sensors:
            self._visited.add(
                MESSAGE_TYPES[sensor.kind],
                sensor.topic,
                partial(self._receive, sensor.name, reader(sensor.kind)),
                _sensor_qos(sensor.queue_size),
                raw=True,
            )
        self._subscribe(PoseWithCovarianceStamped, "set_pose", place, QoSProfile(depth=_QUEUE))
        self._subscribe(tf_message_type(), "/tf_static", self._add_static, _static_qos())
        if settings.control is not None:
            self._subscribe_commands(settings.control)

    @property
    def visited_group(self) -> CallbackGroup:
        """The group of those subscriptions that nobody needs to wait for."""
        return self._visited.group

    def visit(self, now: int) -> None:
        """Take in everything that has arrived by now (ns)."""
        self._visited_at = now
        self._visited.visit()

    def follow_missing_transforms(self) -> None:
        """Subscribe /tf as soon as a transform is missing."""
        if self._moving is None and self._localization.frames.needs_moving_transforms():
            self.follow_moving_transforms()

    def follow_moving_transforms(self) -> None:
        """Subscribe /tf as long as static transforms are not enough: it is the busiest topic of most systems."""
        in_map = self._frames.world == self._frames.map
        needed = in_map or self._localization.frames.needs_moving_transforms()
        if needed and self._moving is None:
            qos = QoSProfile(depth=_TRANSFORM_QUEUE)
            self._moving = self._visited.add(tf_message_type(), "/tf", self._add_moving, qos, raw=True)
        elif not needed and self._moving is not None:
            self._visited.remove(self._moving)
            self._moving = None

    def _subscribe_commands(self, control: Control) -> None:
        if control.stamped:
            self._subscribe(TwistStamped, "cmd_vel", self._command_stamped, QoSProfile(depth=_QUEUE))
        else:
            self._subscribe(Twist, "cmd_vel", self._command, QoSProfile(depth=_QUEUE))

    def _subscribe(
        self, message_type: type, topic: str, callback: Callable[[Message], None], qos: QoSProfile
    ) -> None:
        self._node.create_subscription(message_type, topic, callback, qos, event_callbacks=quiet.SUBSCRIPTION)

    def _receive(self, sensor: str, read: Callable[[bytes], Heard], data: bytes) -> None:
        self._localization.hear(sensor, read(data), self._visited_at)

    def _add_static(self, message: Message) -> None:
        for edge in edges(message):
            self._localization.frames.add_static(*edge)

    def _add_moving(self, data: bytes) -> None:
        for edge in transforms(data):
            self._localization.frames.buffer.add(*edge)

    def _command(self, message: Message) -> None:
        self._localization.command(velocity_command(message), self._now())

    def _command_stamped(self, message: Message) -> None:
        frame = message.header.frame_id.lstrip("/")
        if frame not in {"", self._frames.base_link}:
            if self._wrong_frame.passes():
                self._node.get_logger().error(
                    f"cmd_vel: the frame must be {self._frames.base_link}, not {frame}; it is ignored"
                )
            return
        self._localization.command(velocity_command(message.twist), stamp_of(message))


def _sensor_qos(depth: int) -> QoSProfile:
    return QoSProfile(
        depth=depth,
        history=HistoryPolicy.KEEP_LAST,
        reliability=ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.VOLATILE,
    )


def _static_qos() -> QoSProfile:
    return QoSProfile(
        depth=_TRANSFORM_QUEUE,
        history=HistoryPolicy.KEEP_LAST,
        reliability=ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.TRANSIENT_LOCAL,
    )
