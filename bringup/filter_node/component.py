"""The filter as a component: a timer of its container gives it its turns."""

from contextlib import ExitStack
from typing import Any

from rclpy.node import Node

from bringup.filter.settings import NANOSECONDS
from bringup.filter_node.node import FilterNode

# Nanoseconds between two turns on simulated time, less than between two clock messages: each may bring an update.
_TURN = NANOSECONDS // 200
_SHORTEST = NANOSECONDS // 1000


class Ekf(Node):  # type: ignore[misc] # rclpy is untyped
    """The node; takes the keywords of rclpy's Node. Raises ParameterError."""

    def __init__(self, node_name: str = "ekf", **options: Any) -> None:  # noqa: ANN401 - rclpy's own
        super().__init__(node_name, automatically_declare_parameters_from_overrides=True, **options)
        self._filter = FilterNode(self)
        self._closing = ExitStack()
        self._closing.enter_context(self._filter.traced())
        self._turns = self.create_timer(_TURN / NANOSECONDS, self._work)

    def destroy_node(self) -> None:
        """Leave the graph, and close what the filter writes."""
        self._closing.close()
        super().destroy_node()

    def _work(self) -> None:
        self._filter.work()
        simulated = self.get_clock().ros_time_is_active
        period = _TURN if simulated else max(self._filter.time_left(), _SHORTEST)
        if period != self._turns.timer_period_ns:
            self._turns.timer_period_ns = period
