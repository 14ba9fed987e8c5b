"""A hidden node of ours in the graph, for as long as a command lasts."""

from __future__ import annotations

import os
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Final, TypeVar

import rclpy
from rclpy.exceptions import NameValidationException
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.signals import SignalHandlerOptions

from orchestra.errors import RunError
from orchestra.ros.tools.graph.attendance import Attendance
from orchestra.ros.tools.graph.ending import Ending

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Callable, Iterator

    from rclpy.node import Node

_SeenT = TypeVar("_SeenT")

# rclpy hears of a signal between two waits.
_PAUSE: Final = 0.1
_LOOK: Final = 0.005
_MEETING: Final = 0.02
_CHANGING: Final = 6
_NO_SUPPORT: Final = "Type support not from this implementation"
# No log file: it would be a new one for each command.
_ARGUMENTS: Final = ("--ros-args", "--disable-external-lib-logs")


class Graph:
    """What our node sees of the graph.

    `spin_time` is the longest time in seconds without anything new to wait for, where not all of it is seen.
    """

    def __init__(self, node: Node, spin_time: float, ending: Ending) -> None:
        self.node = node
        self._ending = ending
        self._began = time.monotonic()
        self._spin_time = spin_time
        self._met = False
        self._attendance = Attendance(node)
        self._executor = SingleThreadedExecutor(context=node.context)
        self._executor.add_node(node)

    def spin(self, seconds: float = _PAUSE) -> None:
        """Let what has come in be heard, and wait for it at most so long."""
        self._executor.spin_once(timeout_sec=min(seconds, _PAUSE))
        self._ending.check()

    def pause(self, seconds: float) -> None:
        """Let a time pass in which nothing is heard, for those who take what comes themselves."""
        self._has_met()
        time.sleep(seconds)
        self._ending.check()

    def wait(self, holds: Callable[[], Any], seconds: float | None) -> bool:
        """Wait until something holds, without end where no time is given; return whether it does."""
        until = None if seconds is None else time.monotonic() + seconds
        while not holds():
            left = _PAUSE if until is None else until - time.monotonic()
            if left <= 0:
                return False
            self.spin(min(left, _PAUSE if self._has_met() else _MEETING))
        return True

    def _has_met(self) -> bool:
        """Tell whether all others are known, and ask them to name themselves where they are not."""
        if not self._met:
            self._met = self._attendance.complete() or self._is_late()
        return self._met

    def _is_late(self) -> bool:
        """Tell whether nothing new has come for too long, or new things do not cease."""
        changing = time.monotonic() - self._began
        return self._attendance.silent(self._spin_time) or changing > _CHANGING * self._spin_time

    def found(self, look: Callable[[], _SeenT]) -> _SeenT:
        """Return the first that is seen and counts as true, else what is seen once all of the graph is."""
        while not (seen := look()):
            if self._is_whole(lambda: seen):
                return look()
        return seen

    def whole(self, look: Callable[[], _SeenT]) -> _SeenT:
        """Return what is seen once all of the graph is, and it stays as it is."""
        while True:
            seen = look()
            if self._is_whole(lambda seen=seen: seen):  # type: ignore[misc]
                return seen

    def _is_whole(self, seen: Callable[[], Any]) -> bool:
        """Tell whether nobody is missing and nothing changes any more; a moment passes otherwise."""
        if self._attendance.settled(seen()) or self._is_late():
            return True
        time.sleep(_LOOK)
        self._ending.check()
        return False

    def close(self) -> None:
        """Leave the graph, and take back what was said to others to make them known."""
        self._attendance.close()
        self.node.destroy_node()


@contextmanager
def joined(options: Namespace) -> Iterator[Graph]:
    """Join the graph with a hidden node."""
    rclpy.init(args=list(_ARGUMENTS), signal_handler_options=SignalHandlerOptions.NO)
    try:
        with Ending() as ending:
            graph = Graph(_node(options), float(options.spin_time), ending)
            try:
                yield graph
            except NameValidationException as error:
                raise RunError(
                    " ".join(str(error).replace("^", "").split())
                ) from None  # it points with a caret
            except ValueError as error:
                if _NO_SUPPORT in str(error):
                    raise RunError(f"the libraries of a type are not to be found: {_reason(error)}") from None
                raise
            finally:
                graph.close()
    finally:
        rclpy.try_shutdown()


def _reason(error: ValueError) -> str:
    """Return the line of a message of rcl that says what is wrong."""
    told = [line.strip() for line in str(error).splitlines()]
    return next((line for line in told if "dlopen" in line), told[0])


def _node(options: Namespace) -> Node:
    return rclpy.create_node(
        getattr(options, "node_name", None) or f"_orchestra_{os.getpid()}",
        start_parameter_services=False,
        enable_rosout=False,
        parameter_overrides=[Parameter("use_sim_time", value=True)] if options.use_sim_time else [],
    )
