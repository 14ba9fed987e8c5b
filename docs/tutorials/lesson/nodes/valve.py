"""A device with states: a lifecycle node."""

from __future__ import annotations

from contextlib import suppress
from typing import Any

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.lifecycle import LifecycleNode, State, TransitionCallbackReturn
from std_msgs.msg import Bool


class Valve(LifecycleNode):
    """Publishes on `open` whether it is open: only while it is active."""

    def __init__(self, **options: Any) -> None:
        super().__init__("valve", **options)
        self.declare_parameter("stuck", False)

    def on_configure(self, state: State) -> TransitionCallbackReturn:
        """Get ready; a valve that is stuck cannot."""
        if self.get_parameter("stuck").value:
            self.get_logger().error("the valve is stuck")
            return TransitionCallbackReturn.FAILURE
        self._publisher = self.create_lifecycle_publisher(Bool, "open", 10)
        self._timer = self.create_timer(0.2, lambda: self._publisher.publish(Bool(data=True)))
        return super().on_configure(state)

    def on_cleanup(self, state: State) -> TransitionCallbackReturn:
        """Give back what was made to get ready."""
        self.destroy_timer(self._timer)
        self.destroy_publisher(self._publisher)
        return super().on_cleanup(state)


def main() -> None:
    """Run the node until it is told to end."""
    rclpy.init()
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(Valve())


if __name__ == "__main__":
    main()
