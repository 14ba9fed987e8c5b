"""What is seen of the graph by a node of ours, or by who asks for it without one."""

from __future__ import annotations

import os
import re
import time
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING, Any, Final, Protocol, TypeVar

from orchestra.errors import RunError
from orchestra.ros.tools.graph.ending import Ending
from orchestra.ros.tools.graph.servers import Servers
from orchestra.ros.tools.graph.wire.speaking import domain_on_wire
from orchestra.ros.tools.telling import warn

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Callable, Iterator

_SeenT = TypeVar("_SeenT")

# rclpy hears of a signal between two waits.
_PAUSE: Final = 0.1
_MEETING: Final = 0.02
_CHANGING: Final = 6
_LATE: Final = "not everybody has answered, so something may be missing (--spin-time waits for longer)"
_NO_SUPPORT: Final = "Type support not from this implementation"
_REFUSAL: Final = "RCLError"  # of a module that not all who join have imported
_AT: Final = re.compile(r", at /.*")
_NO_NAME: Final = "' is invalid: "
# No log file: it would be a new one for each command.
ARGUMENTS: Final = ("--ros-args", "--disable-external-lib-logs")


class Attendance(Protocol):
    """Knows when all of the graph has been seen."""

    def complete(self) -> bool:
        """Tell whether nobody is missing."""

    def settled(self, seen: Any) -> bool:  # noqa: ANN401 - whatever is looked for
        """Tell whether nobody is missing, and this is all there is."""

    def silent(self, seconds: float) -> bool:
        """Tell whether nothing new has been seen for this time, though it was looked for."""

    def stopped(self) -> frozenset[int]:
        """Return the processes that have not answered because they are stopped."""

    def rest(self) -> None:
        """Let a moment pass in which something new may come."""

    def close(self) -> None:
        """Take back what was said to others to make them known."""


class Graph:
    """What our node sees of the graph.

    `spin_time` is the longest time in seconds without anything new to wait for, where not all of it is seen. `hear`
    lets what has come in be heard, and waits for it at most so many seconds.
    """

    def __init__(
        self,
        node: Any,  # noqa: ANN401 - one of rclpy, a bare one, or none
        attendance: Attendance,
        spin_time: float,
        ending: Ending,
        hear: Callable[[float], None],
    ) -> None:
        self.node = node
        self._ending = ending
        self._hear = hear
        self._began = time.monotonic()
        self._spin_time = spin_time
        self._met = False
        self._gave_up = False
        self._attendance = attendance
        self._servers = Servers(os.environ.get("ROS_DISCOVERY_SERVER", ""))

    def spin(self, seconds: float = _PAUSE) -> None:
        """Let what has come in be heard, and wait for it at most so long."""
        self._hear(min(seconds, _PAUSE))
        self._ending.check()

    def pause(self, seconds: float) -> None:
        """Let a time pass in which nothing is heard, for those who take what comes themselves."""
        self._has_met()
        time.sleep(seconds)
        self._ending.check()

    def wait(self, holds: Callable[[], Any], seconds: float | None, look: float = _PAUSE) -> bool:
        """Wait until something holds, without end where no time is given; return whether it does.

        Each message that is heard may make it hold; what nobody tells of is looked at after `look` seconds each.
        """
        until = None if seconds is None else time.monotonic() + seconds
        while not holds():
            left = _PAUSE if until is None else until - time.monotonic()
            if left <= 0:
                return False
            self.spin(min(left, look if self._has_met() else min(look, _MEETING)))
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
        while not self._is_late() and not self._attendance.complete():
            self._rest()
        while True:
            seen = look()
            if self._is_whole(lambda seen=seen: seen):  # type: ignore[misc]
                return seen

    def _is_whole(self, seen: Callable[[], Any]) -> bool:
        """Tell whether nobody is missing and nothing changes any more; a moment passes otherwise."""
        if self._attendance.settled(seen()):
            return True
        if self._is_late():
            self._gave_up = True
            return True
        self._rest()
        return False

    def _rest(self) -> None:
        self._attendance.rest()
        self._ending.check()

    def close(self) -> None:
        """Leave the graph, and take back what was said to others to make them known."""
        self._attendance.close()
        self._ending.leave()
        self.node.destroy_node()
        complaint = self._servers.complaint() or (_LATE if self._gave_up else self._of_the_stopped())
        if complaint:
            warn(f"warning: {complaint}")

    def _of_the_stopped(self) -> str | None:
        stopped = ", ".join(map(str, sorted(self._attendance.stopped())))
        return f"what is stopped has not answered, and is missing: process {stopped}" if stopped else None


@contextmanager
def looking(options: Namespace) -> Iterator[Graph]:
    """Look at the graph: on the wire where that can tell all of it, else with a hidden bare node."""
    with Ending() as ending, ExitStack() as stack:
        domain = domain_on_wire(os.environ)
        graph = _with_node(options, ending, stack) if domain is None else _on_wire(options, ending, domain)
        stack.callback(graph.close)
        try:
            yield graph
        except ValueError as error:
            raise told(error) from None


def _on_wire(options: Namespace, ending: Ending, domain: int) -> Graph:
    from orchestra.ros.tools.graph.wire.node import WireNode  # noqa: PLC0415 - only one of both ways is taken

    node = WireNode(domain, own_name(options))
    return Graph(node, node, float(options.spin_time), ending, node.hear)


def _with_node(options: Namespace, ending: Ending, stack: ExitStack) -> Graph:
    """Return what a node sees; its context is left to the stack."""
    from orchestra.ros.tools.graph.bare import BareContext, BareNode  # noqa: PLC0415 - as above
    from orchestra.ros.tools.graph.counting import Counted  # noqa: PLC0415 - as above

    with entering():
        context = BareContext(ARGUMENTS)
        stack.callback(context.close)
        node = BareNode(own_name(options), context)
    return Graph(node, Counted(node), float(options.spin_time), ending, node.hear)


@contextmanager
def entering() -> Iterator[None]:
    """Tell the user what rcl refuses of his environment: the domain, the middleware, security."""
    try:
        yield
    except RuntimeError as error:
        if type(error).__name__ != _REFUSAL:
            raise
        reason = _AT.sub("", str(error).partition("\n")[0])
        raise RunError(f"the graph cannot be joined: {reason}") from None


def own_name(options: Namespace) -> str:
    """Return the name of our node."""
    return getattr(options, "node_name", None) or f"_orchestra_{os.getpid()}"


def told(error: ValueError) -> Exception:
    """Return what tells the user of libraries that are not there, or of what is no name; any other error as it is."""
    lines = [line.strip() for line in str(error).splitlines()]
    if _NO_SUPPORT in str(error):
        reason = next((line for line in lines if "dlopen" in line), lines[0])
        return RunError(f"the libraries of a type are not to be found: {reason}")
    if _NO_NAME in str(error):
        return RunError(lines[0].partition(", at /")[0])
    return error
