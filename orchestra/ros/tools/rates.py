"""`topic hz`, `topic bw`, `topic delay`: once a second, what has come in."""

from __future__ import annotations

import time
from collections import deque
from typing import TYPE_CHECKING, Any, Final, NoReturn

from rclpy.qos import HistoryPolicy, QoSProfile, ReliabilityPolicy

from orchestra.errors import RunError
from orchestra.nearest import nearest
from orchestra.ros.tools.graph.hearing import subscribe, type_of
from orchestra.ros.tools.graph.joining import joined
from orchestra.ros.tools.graph.names import absolute, topics
from orchestra.ros.tools.measuring import (
    Intervals,
    Window,
    bandwidth_data,
    bandwidth_text,
    delay_data,
    delay_text,
    rate_data,
    rate_text,
)
from orchestra.ros.tools.messages.expressions import passes
from orchestra.ros.tools.messages.types import message_class
from orchestra.ros.tools.telling import remark, tell

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Callable

    from orchestra.ros.tools.graph.joining import Graph

    Report = Callable[[], tuple[str, Any] | None]

_NANOSECONDS: Final = 1e9
_EVERY: Final = 1.0
# As sensor data, but nothing is lost while this process does something else for a moment.
_DEEP: Final = 2000


def hz(options: Namespace) -> NoReturn:
    """Write how often messages come."""
    intervals = Intervals(options.window)
    keep = passes(options.filter)
    with joined(options) as graph:
        clock = graph.node.get_clock() if options.use_sim_time and not options.wall_time else None

        def heard(message: Any, about: dict[str, Any]) -> None:  # noqa: ANN401 - of any class
            if keep(message):
                nanoseconds = about["received_timestamp"] if clock is None else clock.now().nanoseconds
                intervals.hear(nanoseconds / _NANOSECONDS)

        def report() -> tuple[str, Any] | None:
            summary = intervals.summary()
            return None if summary is None else (rate_text(summary), rate_data(summary))

        _watch(graph, options, heard, report, lambda: intervals.heard, raw=options.filter is None)


def bw(options: Namespace) -> NoReturn:
    """Write how much comes in."""
    sizes = Window(options.window)
    times: deque[float] = deque(maxlen=options.window)

    def heard(message: bytes, _about: dict[str, Any]) -> None:
        sizes.add(len(message))
        times.append(time.monotonic())

    def report() -> tuple[str, Any] | None:
        summary = sizes.summary()
        if summary is None or summary.count < 2:  # noqa: PLR2004 - one has no rate
            return None
        seconds = time.monotonic() - times[0]
        return bandwidth_text(summary, seconds), bandwidth_data(summary, seconds)

    with joined(options) as graph:
        _watch(
            graph,
            options,
            heard,
            report,
            lambda: sizes.heard,
            raw=True,
            begin=f"Subscribed to [{options.topic}]",
        )


def delay(options: Namespace) -> NoReturn:
    """Write how old messages are when they come, by the stamps of their headers."""
    delays = Window(options.window)
    with joined(options) as graph:
        clock = graph.node.get_clock()

        def heard(message: Any, _about: dict[str, Any]) -> None:  # noqa: ANN401 - as above
            if not hasattr(message, "header"):
                raise RunError(f"messages of type {type(message).__name__} have no header with a stamp")
            stamp = message.header.stamp
            delays.add(clock.now().nanoseconds / _NANOSECONDS - (stamp.sec + stamp.nanosec / _NANOSECONDS))

        def report() -> tuple[str, Any] | None:
            summary = delays.summary()
            return None if summary is None else (delay_text(summary), delay_data(summary))

        _watch(graph, options, heard, report, lambda: delays.heard, raw=False, silence="no new messages")


def _watch(
    graph: Graph,
    options: Namespace,
    heard: Callable[[Any, dict[str, Any]], None],
    report: Report,
    count: Callable[[], int],
    *,
    raw: bool,
    begin: str | None = None,
    silence: str | None = None,
) -> NoReturn:
    """Hear a topic and report until somebody ends it; say `begin` first, and `silence` where nothing new comes."""
    topic = absolute(options.topic)
    if not graph.found(lambda: dict(topics(graph)).get(topic)):
        near = nearest(topic, {name for name, _ in topics(graph)} - {topic})
        hint = f"; did you mean {near}?" if near else ""
        remark(options, f"WARNING: topic [{options.topic}] does not appear to be published yet{hint}")
        graph.wait(lambda: dict(topics(graph)).get(topic), None)
    kind = message_class(type_of(graph, topic))
    profile = QoSProfile(
        history=HistoryPolicy.KEEP_LAST, depth=_DEEP, reliability=ReliabilityPolicy.BEST_EFFORT
    )
    subscribe(graph.node, kind, topic, profile, heard, raw=raw)
    if begin is not None:
        remark(options, begin)
    due, told = time.monotonic() + _EVERY, 0
    while True:
        graph.wait(lambda: False, due - time.monotonic())
        due = max(due + _EVERY, time.monotonic())
        found = report()
        if count() != told and found is not None:
            tell(options, *found)
        elif found is not None and silence is not None:
            remark(options, silence)
        told = count()
