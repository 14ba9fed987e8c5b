"""Publishes estimates: `odometry/filtered`, `accel/filtered` and the transform of the base on /tf."""

import math
from typing import Any, TypeAlias

from geometry_msgs.msg import AccelWithCovarianceStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node

from bringup.filter.localization import Estimate, Localization
from bringup.filter.rigid import Transform
from bringup.filter.rotation import matrix_from_rpy
from bringup.filter.settings import Settings
from bringup.filter.state import ORIENTATION, POSE
from bringup.filter.transforms import TransformUnavailableError
from bringup.filter_node import quiet
from bringup.filter_node.messages import EstimateMessages
from bringup.filter_node.throttle import Throttle
from orchestra.ros.interfaces import tf_message_type

Publisher: TypeAlias = Any

_QUEUE = 10
_TRANSFORM_QUEUE = 100
_SECONDS_BETWEEN_COMPLAINTS = 5.0


class Outputs:
    """The publishers of one filter."""

    def __init__(self, node: Node, settings: Settings, localization: Localization) -> None:
        self._logger = node.get_logger()
        self._not_finite = Throttle(_SECONDS_BETWEEN_COMPLAINTS)
        self._no_odometry = Throttle(_SECONDS_BETWEEN_COMPLAINTS)
        self._frames = settings.frames
        self._offset = settings.publication.transform_offset
        self._buffer = localization.frames.buffer
        self._in_map = settings.frames.world == settings.frames.map
        child = settings.frames.odom if self._in_map else settings.frames.base_link_output
        self._messages = EstimateMessages(settings.frames, (settings.frames.world, child))
        self._odometry = _publisher(node, Odometry, "odometry/filtered", _QUEUE)
        self._acceleration = self._transforms = None
        if settings.publication.acceleration:
            self._acceleration = _publisher(node, AccelWithCovarianceStamped, "accel/filtered", _QUEUE)
        # In any other frame there is no transform that would be the filter's to give (told with the parameters).
        if settings.publication.transform and settings.frames.world in {
            settings.frames.map,
            settings.frames.odom,
        }:
            self._transforms = _publisher(node, tf_message_type(), "/tf", _TRANSFORM_QUEUE)

    def publish(self, estimate: Estimate) -> bool:
        """Publish an estimate; one that is not finite is only complained about (upstream publishes it)."""
        if not (math.isfinite(estimate.state.sum()) and math.isfinite(estimate.covariance.sum())):
            if self._not_finite.passes():
                self._logger.error(
                    "critical error, NaNs in the estimate: nothing is published; call the reset service"
                )
            return False
        self._odometry.publish(self._messages.odometry(estimate))
        if self._acceleration is not None:
            self._acceleration.publish(self._messages.acceleration(estimate))
        self._broadcast(estimate)
        return True

    def _broadcast(self, estimate: Estimate) -> None:
        if self._transforms is None:
            return
        if not self._in_map:
            self._transforms.publish(self._messages.base(estimate, self._offset))
            return
        odometry = self._odometry_transform()
        if odometry is None:
            return
        rotation = matrix_from_rpy(*estimate.state[ORIENTATION].tolist())
        place = Transform(rotation, estimate.state[POSE][:3]) @ odometry.inverse()
        self._transforms.publish(self._messages.transform(place, estimate.stamp + self._offset))

    def _odometry_transform(self) -> Transform | None:
        """Find where somebody else's odometry has the base, for a filter in the map frame."""
        try:
            return self._buffer.lookup(self._frames.odom, self._frames.base_link)
        except TransformUnavailableError as error:
            text = f"{self._frames.map} -> {self._frames.odom} is not broadcast: {error}"
        if self._no_odometry.passes():
            self._logger.error(text)
        return None


def _publisher(node: Node, message_type: type, topic: str, depth: int) -> Publisher:
    return node.create_publisher(message_type, topic, depth, event_callbacks=quiet.PUBLISHER)
