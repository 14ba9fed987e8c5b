"""`lifecycle_node`: starts a ROS node with a managed life cycle."""

from __future__ import annotations

from orchestra.description.actions.node import Node
from orchestra.description.fields import Flag, Text
from orchestra.description.model import field


class LifecycleNode(Node):
    """Start a ROS node with a managed life cycle. Upstream spells the tag only in releases after Jazzy."""

    name: Text = field(description="Name of the node.")
    namespace: Text | None = field(description="Namespace; a relative one is put below the pushed one.")
    autostart: Flag | None = field(
        default=None, description="Whether it is configured and activated when it has started."
    )
