"""The filter's node: its timer on ROS time, its services and its logging."""

from contextlib import AbstractContextManager
from time import perf_counter

from rclpy.callback_groups import CallbackGroup
from rclpy.node import Node

from bringup.filter.checks import doubts
from bringup.filter.localization import Localization
from bringup.filter.notices import Level
from bringup.filter.settings import NANOSECONDS
from bringup.filter_node.configuration import configure
from bringup.filter_node.debugging import traced
from bringup.filter_node.diagnostics import Diagnostics
from bringup.filter_node.inputs import Inputs
from bringup.filter_node.lateness import Lateness
from bringup.filter_node.outputs import Outputs
from bringup.filter_node.pace import Pace
from bringup.filter_node.services import Services
from bringup.filter_node.ticks import Ticks

# Seconds of real time, so that a clock that jumps about cannot flood the log.
_HOUSEKEEPING = 1.0
# Nanoseconds of real time.
_VISIT_PERIOD = NANOSECONDS // 50
_LONGEST_WAIT = NANOSECONDS


class FilterNode:
    """One filter on one ROS node, in whatever namespace that is. Raises ParameterError."""

    def __init__(self, node: Node) -> None:
        self._logger = node.get_logger()
        self._clock = node.get_clock()
        settings = configure(node)
        self._localization = Localization(settings)
        services = Services(node, self._localization, self._now, self._take_in)
        self._inputs = Inputs(node, settings, self._localization, self._now, services.place)
        self._outputs = Outputs(node, settings, self._localization)
        self._diagnostics = Diagnostics(node, settings) if settings.publication.diagnostics else None
        self._period = round(NANOSECONDS / settings.timing.frequency)
        self._kept_house: float | None = None
        self._is_settled = False
        self._lateness = Lateness(self._period / NANOSECONDS)
        self._told: frozenset[str] = frozenset()
        self._debug_file = settings.publication.debug_file
        for _, _, text in doubts(settings):
            # However bad for the estimate, nothing that is wrong with the parameters as such.
            self._log(Level.WARN, text)
        if not self._localization.enabled:
            self._logger.info("the filter is disabled at start-up; the enable service starts it")
        self._ticks = Ticks(node, settings.timing.frequency)
        self._pace = Pace()

    @property
    def visited_group(self) -> CallbackGroup:
        """The group of those subscriptions that nobody needs to wait for."""
        return self._inputs.visited_group

    def traced(self) -> AbstractContextManager[None]:
        """Write a trace of each measurement to the debug file, if the parameters say so."""
        return traced(self._debug_file, self._localization, self._logger)

    def time_left(self) -> int:
        """Tell how long the filter can do without being asked to work (ns)."""
        longest = _VISIT_PERIOD if self._period > _VISIT_PERIOD else _LONGEST_WAIT
        left = self._ticks.left()
        return longest if left is None else min(left, longest)

    def rest(self) -> float:
        """Tell how long it is no use to look at the clock (s of real time): 0 where no clock message wakes the node."""
        if not self._clock.ros_time_is_active:
            return 0.0
        return self._pace.rest(self._ticks.to_go, perf_counter())

    def work(self) -> None:
        """Fuse and publish if an update is due; between rare updates only empty the sensors' queues."""
        now = self._ticks.take()
        if now is not None:
            self._update(now)
        elif self._period > _VISIT_PERIOD:
            self._inputs.visit(self._now())

    def _now(self) -> int:
        return int(self._clock.now().nanoseconds)

    def _take_in(self) -> None:
        self._inputs.visit(self._now())

    def _update(self, now: int) -> None:
        began = perf_counter()
        self._pace.note(now, began)
        self._inputs.visit(now)
        self._inputs.follow_missing_transforms()
        self._localization.update(now)
        estimate = self._localization.estimate_to_publish()
        if estimate is not None and self._outputs.publish(estimate) and self._diagnostics is not None:
            self._diagnostics.count()
        if self._kept_house is None:
            self._kept_house = began
        elif began - self._kept_house >= _HOUSEKEEPING:
            self._kept_house = began
            self._keep_house(now)
            self._is_settled = True
        # The first updates also pay for what is loaded at first use.
        if self._is_settled:
            self._watch_rate(began, perf_counter())

    def _watch_rate(self, began: float, ended: float) -> None:
        """Tell when updates begin to take too long, and when that is over."""
        if (complaint := self._lateness.begins(ended - began, ended)) is not None:
            self._logger.error(complaint)
        if (relief := self._lateness.ends(ended)) is not None:
            self._logger.info(relief)

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
