"""The velocity controller as a node like any other, and as a component, whose container gives it its turns."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy.node import Node

from bringup.control_node.node import VelocityController
from bringup.control_node.parameters import declared

if TYPE_CHECKING:
    from typing import Any

PERIOD = 0.1


class PlainVelocityController(Node):  # type: ignore[misc] # rclpy is untyped
    """The node. Raises what `declared` raises."""

    def __init__(self, **options: Any) -> None:  # noqa: ANN401 - rclpy's own arguments of a node
        super().__init__("velocity_controller", **options)
        self._controller = VelocityController(self, declared(self))

    def tick(self) -> None:
        """Send the next command."""
        self._controller.tick()

    def stand_still(self, reason: str) -> None:
        """Send a last order to stand still."""
        self._controller.stand_still(reason)


class Component(PlainVelocityController):
    """The same for a container: a timer makes the ticks, and unloading it makes the robot stand."""

    def __init__(self, **options: Any) -> None:  # noqa: ANN401 - rclpy's own arguments of a node
        super().__init__(**options)
        self.create_timer(PERIOD, self.tick)

    def destroy_node(self) -> None:
        """Stand still and leave the graph."""
        self.stand_still("the component was unloaded")
        super().destroy_node()
