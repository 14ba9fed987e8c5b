"""Observes a running graph: what is there, what its nodes answer, what comes on /clock and as transforms."""

from __future__ import annotations

import time
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from rcl_interfaces.srv import GetParameters
from rclpy.qos import HistoryPolicy, QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock

from orchestra.ros.interfaces import tf_message_type
from orchestra.ros.observer.service import OwnService
from orchestra.ros.tools.doctor.members import members
from orchestra.ros.tools.doctor.observed import Heard, Observed, Tick
from orchestra.ros.tools.graph.hearing import subscribe
from orchestra.ros.tools.graph.system import system
from orchestra.ros.tools.transforms import MOVING, STATIC

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.ros.tools.graph.joining import Graph
    from orchestra.ros.tools.graph.system import System

_ASK: Final = "/get_parameters"
_ASKED: Final = "rcl_interfaces/srv/GetParameters"
_SIM_TIME: Final = "use_sim_time"
_HEARD: Final = ("/clock", "/tf", "/tf_static")
_CLOCK: Final = QoSProfile(
    history=HistoryPolicy.KEEP_LAST, depth=1000, reliability=ReliabilityPolicy.BEST_EFFORT
)
_NANOSECONDS: Final = 1e9


def observed(graph: Graph, options: Namespace) -> Observed:
    """Return what is seen; it takes as long as the options say, where there is something to hear."""
    wanted = set(options.checks)
    ears = _Ears(graph) if wanted & {"clock", "frames"} else None
    seen = graph.whole(lambda: system(graph)).without_hidden()
    began, wall = time.monotonic(), time.time()
    answers = _sim_time(graph, seen, options.timeout) if wanted & {"answers", "time"} else {}
    if ears and any(end.topic in _HEARD for end in seen.publishers):
        graph.wait(lambda: False, began + options.listen - time.monotonic())
    until = time.time()
    return Observed(
        seen,
        {node: answer for node, answer in answers.items() if answer is not None},
        tuple(node for node, answer in answers.items() if answer is None),
        tuple(ears.ticks) if ears else (),
        tuple(ears.transforms) if ears else (),
        until,
        (until - wall) - (time.monotonic() - began),
        members() if "settings" in wanted else (),
    )


class _Ears:
    """Hears /clock and transforms, each message with the time at which it was sent."""

    def __init__(self, graph: Graph) -> None:
        self.ticks: list[Tick] = []
        self.transforms: list[Heard] = []
        kind = tf_message_type()
        node = graph.node
        subscribe(node, Clock, "/clock", _CLOCK, self._tick)
        subscribe(node, kind, "/tf", MOVING, lambda message, about: self._hear(message, about, static=False))
        subscribe(
            node, kind, "/tf_static", STATIC, lambda message, about: self._hear(message, about, static=True)
        )

    def _tick(self, message: Any, about: dict[str, Any]) -> None:  # noqa: ANN401 - of an untyped package
        self.ticks.append(Tick(about["source_timestamp"] / _NANOSECONDS, _seconds(message.clock)))

    def _hear(self, message: Any, about: dict[str, Any], *, static: bool) -> None:  # noqa: ANN401 - as above
        sent = about["source_timestamp"] / _NANOSECONDS
        self.transforms += [
            Heard(
                one.header.frame_id.removeprefix("/"),
                one.child_frame_id.removeprefix("/"),
                static,
                _seconds(one.header.stamp),
                sent,
            )
            for one in message.transforms
        ]


def _sim_time(graph: Graph, seen: System, timeout: float) -> dict[str, bool | None]:
    """Return whether each node takes its time from /clock; None for one that does not answer in time.

    Nodes without services for their parameters are left out. All are asked at once.
    """
    offered = {name for name, types in seen.services if _ASKED in types}
    nodes = [node for node in dict.fromkeys(seen.nodes) if f"{node}{_ASK}" in offered]
    clients = {node: OwnService(graph.node, GetParameters, f"{node}{_ASK}") for node in nodes}
    answers: dict[str, bool | None] = {}
    asked: set[str] = set()

    def all_answered() -> bool:
        for node, client in clients.items():
            if node not in asked and client.ready:
                asked.add(node)
                client.ask(
                    GetParameters.Request(names=[_SIM_TIME]), partial(_answer, answers, node), repeat=True
                )
            client.look()
        return len(answers) == len(clients)

    try:
        graph.wait(all_answered, timeout)
    finally:
        for client in clients.values():
            client.close()
    return {node: answers.get(node) for node in nodes}


def _answer(answers: dict[str, bool | None], node: str, response: Any) -> None:  # noqa: ANN401 - of an untyped package
    answers[node] = response is not None and any(value.bool_value for value in response.values)


def _seconds(stamp: Any) -> float:  # noqa: ANN401 - of an untyped package
    return float(stamp.sec + stamp.nanosec / _NANOSECONDS)
