"""Waits for first messages on topics. The graph is looked at ten times a second, and only while something is awaited.

rclpy shows no graph event, so polling it is; one look costs some microseconds. A subscription must offer no more than a
publisher does to be matched (REP 2004's QoS compatibility rules), so there is one for every combination of reliability
and durability that some publisher offers: whichever publishes first is heard.
"""

from __future__ import annotations

import json
import os
import select
from typing import TYPE_CHECKING

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions

from orchestra.ros.interfaces import UnknownMessageTypeError, message_type

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node
    from rclpy.subscription import Subscription

_LOOK_EVERY = 0.1


class Wait:
    """Waits for the first message on one topic; `answer` is called with None when it came, else with what is wrong."""

    def __init__(self, node: Node, topic: str, answer: Callable[[str | None], None]) -> None:
        self._node = node
        self._topic = topic
        self._answer = answer
        self._subscriptions: dict[tuple[str, ReliabilityPolicy, DurabilityPolicy], Subscription] = {}
        self.over = False

    def look(self) -> None:
        """Subscribe to what publishers offer by now."""
        for publisher in self._node.get_publishers_info_by_topic(self._topic):
            profile = publisher.qos_profile
            key = (publisher.topic_type, profile.reliability, profile.durability)
            if key not in self._subscriptions and not self.over:
                self._subscribe(key)

    def close(self) -> None:
        """Give the subscriptions back."""
        self.over = True
        for subscription in self._subscriptions.values():
            self._node.destroy_subscription(subscription)
        self._subscriptions.clear()

    def _subscribe(self, key: tuple[str, ReliabilityPolicy, DurabilityPolicy]) -> None:
        name, reliability, durability = key
        try:
            kind = message_type(name)
        except (UnknownMessageTypeError, ImportError) as error:
            self._finish(f"{self._topic} carries {name}, which cannot be loaded: {error}")
            return
        profile = QoSProfile(
            history=HistoryPolicy.KEEP_LAST, depth=1, reliability=reliability, durability=durability
        )
        self._subscriptions[key] = self._node.create_subscription(
            kind, self._topic, lambda _data: self._finish(None), profile, raw=True
        )

    def _finish(self, problem: str | None) -> None:
        if not self.over:
            self.over = True
            self._answer(problem)


class Requests:
    """Reads requests, one JSON object per line."""

    def __init__(self, descriptor: int) -> None:
        self._descriptor = descriptor
        self._partial = b""
        self.ended = False

    def read(self, timeout: float | None) -> list[dict[str, str]]:
        """Return what has come; wait at most `timeout` seconds for something, None for as long as it takes."""
        if not select.select([self._descriptor], [], [], timeout)[0]:
            return []
        data = os.read(self._descriptor, 65536)
        self.ended = not data
        *lines, self._partial = (self._partial + data).split(b"\n")
        return [json.loads(line) for line in lines]


def observe(requests: int, answers: int) -> None:
    """Serve the supervisor on two descriptors until the first one ends."""
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
    try:
        # The underscore makes it a hidden node, which tools leave out.
        node = rclpy.create_node(
            f"_orchestra_observer_{os.getpid()}",
            start_parameter_services=False,
            enable_rosout=False,
            use_global_arguments=False,
        )
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        _serve(Requests(requests), answers, node, executor)
        executor.shutdown()
        node.destroy_node()
    finally:
        rclpy.try_shutdown()


def _serve(requests: Requests, answers: int, node: Node, executor: SingleThreadedExecutor) -> None:
    waits: dict[str, Wait] = {}
    while not requests.ended:
        for request in requests.read(0.0 if waits else None):
            _take(request, waits, node, answers)
        for wait in waits.values():
            wait.look()
        if waits:
            executor.spin_once(timeout_sec=_LOOK_EVERY)
        for name in [name for name, wait in waits.items() if wait.over]:
            waits.pop(name).close()


def _take(request: dict[str, str], waits: dict[str, Wait], node: Node, answers: int) -> None:
    if "watch" in request:
        name = request["watch"]
        waits[name] = Wait(node, request["topic"], lambda problem: _tell(answers, name, problem))
    elif request["forget"] in waits:
        waits.pop(request["forget"]).close()


def _tell(answers: int, name: str, problem: str | None) -> None:
    message = {"seen": name} if problem is None else {"impossible": name, "reason": problem}
    os.write(answers, (json.dumps(message) + "\n").encode())
