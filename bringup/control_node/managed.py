"""The velocity controller as a managed node (REP-2002, design.ros2.org "Managed nodes").

Unconfigured it has its parameters only; configured it is on the graph and orders the robot to stand; active it
drives. It leaves `active` with an order to stand that has arrived.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn

from bringup.control_node.node import VelocityController
from bringup.control_node.parameters import declared

if TYPE_CHECKING:
    from typing import Any

SUCCESS = TransitionCallbackReturn.SUCCESS


class ManagedVelocityController(LifecycleNode):  # type: ignore[misc] # rclpy is untyped
    """The node and its transitions. Raises what `declared` raises."""

    def __init__(self, **options: Any) -> None:  # noqa: ANN401 - rclpy's own arguments of a node
        super().__init__("velocity_controller", **options)
        self._tuning = declared(self)
        self._controller: VelocityController | None = None
        self._is_active = False

    def tick(self) -> None:
        """Send the next command, if the node is configured."""
        if self._controller is None:
            return
        if self._is_active:
            self._controller.tick()
        else:
            self._controller.stay()

    def stand_still(self, reason: str) -> None:
        """Send a last order to stand still, if the node is configured."""
        if self._controller is not None:
            self._controller.stand_still(reason)

    def on_configure(self, _: LifecycleState) -> TransitionCallbackReturn:
        """Open topics, services and the action."""
        self._controller = VelocityController(self, self._tuning)
        return SUCCESS

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Drive from the next tick on."""
        self._is_active = True
        return super().on_activate(state)

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Stand still, and take no goals."""
        self._rest("the controller was deactivated")
        return super().on_deactivate(state)

    def on_cleanup(self, _: LifecycleState) -> TransitionCallbackReturn:
        """Leave the graph, but for the parameters."""
        self._close("the controller was cleaned up")
        return SUCCESS

    def on_shutdown(self, _: LifecycleState) -> TransitionCallbackReturn:
        """Stand still and leave the graph, whatever the state was."""
        self._close("the controller was shut down")
        return SUCCESS

    def on_error(self, _: LifecycleState) -> TransitionCallbackReturn:
        """Stand still and begin again unconfigured."""
        self._close("the controller has failed")
        return SUCCESS

    def _rest(self, reason: str) -> None:
        self._is_active = False
        self.stand_still(reason)

    def _close(self, reason: str) -> None:
        self._rest(reason)
        if self._controller is not None:
            self._controller.close()
            self._controller = None
