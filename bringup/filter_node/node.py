"""The filter's node: its timer on ROS time, its services and its logging."""

from time import perf_counter
from typing import Any, TypeAlias

from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from std_srvs.srv import Empty

from bringup.filter.checks import doubts
from bringup.filter.localization import Localization
from bringup.filter.notices import Level
from bringup.filter_node.configuration import configure
from bringup.filter_node.diagnostics import Diagnostics
from bringup.filter_node.inputs import Inputs
from bringup.filter_node.outputs import Outputs
from bringup.filter_node.ticks import Ticks
from bringup.filter_node.visits import VISIT_PERIOD

Response: TypeAlias = Any

# Seconds of real time, so that a clock that jumps about cannot flood the log.
_HOUSEKEEPING = 1.0


class FilterNode:
    """One filter on one ROS node, in whatever namespace that is. Raises ParameterError."""

    def __init__(self, node: Node) -> None:
        self._logger = node.get_logger()
        self._clock = node.get_clock()
        settings = configure(node)
        self._localization = Localization(settings)
        self._inputs = Inputs(node, settings, self._localization, self._now)
        self._outputs = Outputs(node, settings, self._localization)
        self._diagnostics = Diagnostics(node, settings) if settings.publication.diagnostics else None
        self._period = 1.0 / settings.timing.frequency
        self._kept_house = perf_counter()
        self._updates = 0
        self._told: frozenset[str] = frozenset()
        for level, _, text in doubts(settings):
            self._log(level, text)
        if not self._localization.enabled:
            self._logger.info("the filter is disabled at start-up; the enable service starts it")
        node.create_service(Empty, "reset", self._reset)
        node.create_service(Empty, "enable", self._enable)
        self._ticks = Ticks(node, settings.timing.frequency)
        if self._period > VISIT_PERIOD:
            steady = Clock(clock_type=ClockType.STEADY_TIME)
            node.create_timer(VISIT_PERIOD, self._inputs.visit, clock=steady)

    def _now(self) -> int:
        return int(self._clock.now().nanoseconds)

    def update_if_due(self) -> None:
        """Fuse and publish if a tick has come; to be called after each callback."""
        now = self._ticks.take()
        if now is not None:
            self._update(now)

    def _update(self, now: int) -> None:
        began = perf_counter()
        self._inputs.visit()
        self._localization.update(now)
        estimate = self._localization.estimate_to_publish()
        if estimate is not None and self._outputs.publish(estimate) and self._diagnostics is not None:
            self._diagnostics.count()
        if began - self._kept_house >= _HOUSEKEEPING:
            self._kept_house = began
            self._keep_house(now)
        took = perf_counter() - began
        self._updates += 1
        # The first update also pays for what is loaded at first use.
        if took > self._period and self._updates > 1:
            text = f"failed to meet update rate: an update took {took:.4f} s of {self._period:.4f} s"
            self._logger.error(text, throttle_duration_sec=5.0)

    def _keep_house(self, now: int) -> None:
        self._inputs.follow_moving_transforms()
        notices = self._localization.notices.take()
        for key, (level, text) in notices.items():
            # What goes on is told once, and again when it has been away.
            if key not in self._told:
                self._log(level, text)
        self._told = frozenset(notices)
        if self._diagnostics is not None:
            self._diagnostics.report(now, notices)

    def _log(self, level: Level, text: str) -> None:
        # rclpy ties each calling line to one severity, so one line cannot log both.
        if level is Level.ERROR:
            self._logger.error(text)
        else:
            self._logger.warning(text)

    def _reset(self, _request: object, response: Response) -> Response:
        self._inputs.visit()
        self._localization.reset()
        self._logger.info("the filter starts afresh")
        return response

    def _enable(self, _request: object, response: Response) -> Response:
        if self._localization.enabled:
            self._logger.warning("the filter is enabled already")
        self._localization.enabled = True
        return response
