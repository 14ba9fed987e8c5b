"""`topic pub`."""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING, Any

from rclpy.duration import Duration
from rclpy.qos import QoSPresetProfiles, ReliabilityPolicy

from orchestra.errors import RunError
from orchestra.ros.tools.graph.joining import joined
from orchestra.ros.tools.graph.names import absolute
from orchestra.ros.tools.graph.qos import chosen
from orchestra.ros.tools.messages.plain import plain
from orchestra.ros.tools.messages.reading import fill_from
from orchestra.ros.tools.messages.types import message_class
from orchestra.ros.tools.telling import as_json, json_line

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.ros.tools.graph.joining import Graph

_TELL_AGAIN = 1.0
# A long message, or one on a busy machine, needs more time to arrive than the ROS 2 tools give it.
_ARRIVAL = 2.0
# We may know of a subscription before it knows of us. One that is reliable asks for what it has missed; others are
# given this time: on a busy machine 3 of 24 messages that were published once were lost without it.
_MEETING = 0.2


def publish(options: Namespace) -> int:
    """Publish a message, once or again and again."""
    topic = absolute(options.topic)
    times = 1 if options.once else options.times
    message = message_class(options.type)()
    timed = fill_from(sys.stdin.read() if options.stdin else options.values, message)
    profile, _ = chosen(options, QoSPresetProfiles.get_from_short_key("system_default"))
    wanted = options.wait_matching_subscriptions
    with joined(options) as graph:
        publisher = graph.node.create_publisher(type(message), topic, profile)
        _wait_for(graph, publisher, (1 if times else 0) if wanted is None else wanted, options)
        _say(options, "publisher: beginning loop\n")
        count, began = 0, time.monotonic()
        while not times or count < times:
            graph.wait(lambda: False, began + count / options.rate - time.monotonic())
            for owner, name, kind in timed:
                setattr(owner, name, _now(graph, kind))
            count += 1
            if options.print and count % options.print == 0:
                _say(options, f"publishing #{count}: {message!r}\n\n", message)
            publisher.publish(message)
        if profile.reliability != ReliabilityPolicy.BEST_EFFORT:  # what is not said is reliable
            publisher.wait_for_all_acked(Duration(seconds=max(options.keep_alive, _ARRIVAL)))
        graph.wait(lambda: False, options.keep_alive)
    return 0


def _wait_for(graph: Graph, publisher: Any, wanted: int, options: Namespace) -> None:  # noqa: ANN401 - untyped package
    """Wait until so many subscriptions are matched. Raises `RunError` where that takes too long."""
    began, told = time.monotonic(), -_TELL_AGAIN
    while (matched := publisher.get_subscription_count()) < wanted:
        now = time.monotonic()
        if options.max_wait_time_secs is not None and now - began >= options.max_wait_time_secs:
            raise RunError(
                f"{wanted} subscriptions of {publisher.topic_name} were to be there within "
                f"{options.max_wait_time_secs:g} s, and {matched} are"
            )
        if now - told >= _TELL_AGAIN:
            _say(options, f"Waiting for at least {wanted} matching subscription(s)...\n")
            told = now
        graph.wait(lambda: publisher.get_subscription_count() >= wanted, 0.1)
    hearers = graph.node.get_subscriptions_info_by_topic(publisher.topic_name) if wanted else []
    if any(one.qos_profile.reliability == ReliabilityPolicy.BEST_EFFORT for one in hearers):
        graph.wait(lambda: False, _MEETING)


def _now(graph: Graph, kind: Any) -> Any:  # noqa: ANN401 - a class of an untyped package
    now = graph.node.get_clock().now().to_msg()
    return now if isinstance(now, kind) else kind(sec=now.sec, nanosec=now.nanosec)


def _say(options: Namespace, text: str, message: Any = None) -> None:  # noqa: ANN401 - as above
    """Write what is done; as JSON, only the messages."""
    if not as_json(options):
        sys.stdout.write(text)
    elif message is not None:
        sys.stdout.write(json_line(plain(message)))
    sys.stdout.flush()
