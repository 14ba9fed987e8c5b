"""A frame can be transformed into another: there is a chain of transforms between them, in either direction.

Times are not compared: a transform that was published once counts. Latched transforms of /tf_static come with the
subscription, whenever they were published.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.ros.observer.offered import Offered
from orchestra.ros.observer.order import OFTEN

if TYPE_CHECKING:
    from collections.abc import Mapping

    from rclpy.node import Node

    from orchestra.ros.observer.order import Request, Say

# tf2_ros::DynamicListenerQoS and StaticListenerQoS ask for 100.
_DEPTH = 100
_TYPE = "tf2_msgs/msg/TFMessage"


class TransformThere:
    """`parent` and `child` are names of frames."""

    def __init__(self, node: Node, request: Request, say: Say) -> None:
        self._say = say
        self._wanted = (_bare(request["parent"]), _bare(request["child"]))
        self._parents: dict[str, str] = {}
        self._subscriptions = [
            Offered(node, topic, self._heard, depth=_DEPTH, only=_TYPE) for topic in ("/tf", "/tf_static")
        ]
        self.every: float | None = OFTEN

    def look(self) -> None:
        """Listen to whoever publishes by now."""
        for subscription in self._subscriptions:
            subscription.look()

    def close(self) -> None:
        """Listen no longer."""
        for subscription in self._subscriptions:
            subscription.close()

    def _heard(self, message: Any) -> None:  # noqa: ANN401 - of an untyped package
        links = {
            _bare(transform.child_frame_id): _bare(transform.header.frame_id)
            for transform in message.transforms
        }
        if not self.every or self._parents.items() >= links.items():
            return
        self._parents.update(links)
        if connected(self._parents, *self._wanted):
            self.every = None
            self._say("done")


def connected(parents: Mapping[str, str], one: str, other: str) -> bool:
    """Tell whether two frames hang on one tree; each frame that has one is mapped to its parent."""
    root = _root(parents, one)
    known = {*parents, *parents.values()}
    return root == _root(parents, other) and {one, other} <= known


def _root(parents: Mapping[str, str], frame: str) -> str:
    """Follow the parents to the end; frames that stand in a circle all have the least of them as their root."""
    seen = [frame]
    while (parent := parents.get(seen[-1])) is not None:
        if parent in seen:
            return min(seen[seen.index(parent) :])
        seen.append(parent)
    return seen[-1]


def _bare(frame: str) -> str:
    """Return a frame's name as tf2 takes it: a slash in front means nothing."""
    return frame.removeprefix("/")
