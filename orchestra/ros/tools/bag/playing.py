"""`bag play`."""

from __future__ import annotations

import sys
import time
from contextlib import ExitStack, closing
from itertools import repeat
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from rclpy.duration import Duration
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.time import Time
from rosgraph_msgs.msg import Clock

from orchestra.errors import OrchestraError, RunError, UsageError
from orchestra.ros.tools.bag.ahead import ahead
from orchestra.ros.tools.bag.classes import recorded_class
from orchestra.ros.tools.bag.offering import offer
from orchestra.ros.tools.bag.overrides import overrides
from orchestra.ros.tools.bag.pace import Pace, with_ticks
from orchestra.ros.tools.bag.reading import Bag
from orchestra.ros.tools.bag.selection import selection
from orchestra.ros.tools.graph.joining import joined
from orchestra.ros.tools.graph.names import absolute
from orchestra.ros.tools.graph.qos import data_of
from orchestra.ros.tools.graph.system import End, mismatch, system
from orchestra.ros.tools.keyboard import keyboard
from orchestra.ros.tools.telling import as_json, tell, warn

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Sequence

    from orchestra.ros.tools.bag.reading import Recorded
    from orchestra.ros.tools.graph.joining import Graph
    from orchestra.ros.tools.graph.system import System
    from orchestra.ros.tools.keyboard import Keyboard

_CLOCK: Final = "/clock"
_NANOSECONDS: Final = 1_000_000_000
_MILLISECOND: Final = 1_000_000
# Keys are looked at, and signals heard, so often while nothing is due; in seconds.
_LOOK: Final = 0.05
_QUIET, _MEET = 0.3, 10.0
_QUICKER: Final = 1.1
_SWITCH: Final = 0.0005  # so long, in seconds, reading ahead may hold up what is due
_KEYS: Final = "space: pause or go on; right: the next message; up, down: quicker, slower; Ctrl-C ends it\n"


def play(options: Namespace) -> int:
    """Publish the messages of a bag in the order and with the timing in which they were recorded."""
    chosen, names = selection(options, default=True), _remapped(options.remap)
    with ExitStack() as stack:
        bag = stack.enter_context(Bag(Path(options.bag)))
        for file in bag.broken:
            warn(f"warning: {file} has no end: what can be read of it is played")
        for name, hint in chosen.missing(topic.name for topic in bag.summary().topics):
            warn(f"warning: there is no {name} in {bag.path}{hint}")
        graph = stack.enter_context(joined(options))
        player = _Player(graph, options)
        for topic in bag.summary().topics:
            if topic.count and chosen.takes(topic.name, topic.type):
                player.publish(topic.name, topic.type, names.get(topic.name, topic.name), topic.profiles)
        if not player.topics:
            raise RunError(f"nothing of {bag.path} is to be played")
        player.meet()
        graph.wait(lambda: False, options.delay)
        keys = (
            None
            if options.disable_keyboard_controls or not sys.stdin.isatty()
            else stack.enter_context(keyboard())
        )
        if not as_json(options):
            sys.stdout.write(f"playing {bag.path}\n" + (_KEYS if keys else ""))
            sys.stdout.flush()
        player.play(bag, keys)
    data = {"path": str(bag.path), "messages": player.count, "late": player.late}
    tell(options, f"{player.count} messages played, none more than {player.late:.3f} s late\n", data)
    return 0


class _Player:
    """Publishers of the topics of a bag, and the pace at which their messages come."""

    def __init__(self, graph: Graph, options: Namespace) -> None:
        self.topics: dict[str, Any] = {}
        self.count = 0
        self.late = 0.0
        self._graph = graph
        self._options = options
        self._keys: Keyboard | None = None
        self._profiles = overrides(options.qos_profile_overrides_path)
        patience = options.wait_for_all_acked
        self._patience = Duration(nanoseconds=patience * _MILLISECOND if patience else -1)
        self._clock: Any = None
        if options.clock is not None:
            self._clock = graph.node.create_publisher(Clock, _CLOCK, QoSProfile(depth=10))

    def publish(self, name: str, kind: str, as_name: str, profiles: tuple[dict[str, Any], ...]) -> None:
        """Have a topic published; one whose type is not here is left out, and so is a clock that is made anew."""
        if self._clock is not None and as_name == _CLOCK:
            warn(f"{name} is not played: --clock publishes it")
            return
        try:
            made = recorded_class(kind)
        except OrchestraError as error:
            warn(f"warning: {name} is not played: {error}")
            return
        profile = self._profiles.get(name) or offer(profiles)
        self.topics[name] = self._graph.node.create_publisher(made, as_name, profile)

    def meet(self) -> None:
        """Wait until those are connected who want to hear these topics, so that they miss nothing of the begin."""
        self._graph.whole(lambda: system(self._graph))
        wanted: dict[str, int] = {}
        since = time.monotonic()

        def met() -> bool:
            """Tell whether all are connected, and nobody has come for a moment: some come because we publish."""
            nonlocal wanted, since
            seen = system(self._graph)
            found = {name: _hearers(seen, publisher) for name, publisher in self.topics.items()}
            if found != wanted:
                wanted, since = found, time.monotonic()
            there = (self.topics[name].get_subscription_count() >= count for name, count in wanted.items())
            return time.monotonic() - since >= _QUIET and all(there)

        self._graph.wait(met, _MEET)

    def play(self, bag: Bag, keys: Keyboard | None) -> None:
        """Play a bag once, or until somebody ends it."""
        self._keys = keys
        sys.setswitchinterval(_SWITCH)
        since, until = self._span(bag)
        period = None if self._clock is None else int(_NANOSECONDS / self._options.clock * self._options.rate)
        pace = Pace(since, time.monotonic(), self._options.rate, paused=self._options.start_paused)
        for _ in repeat(None) if self._options.loop else (None,):
            with closing(ahead(bag.messages(self.topics.__contains__, since, until))) as messages:
                items = with_ticks(((one.log_time, one) for one in messages), period)
                for number, (recorded, message) in enumerate(items):
                    if number == 0:  # it has been read by now
                        pace.step(since, time.monotonic())
                    self._wait(pace, recorded)
                    self._send(recorded, message)
                    if (due := pace.due(recorded)) is not None:  # a busy machine may hold up the sending too
                        self.late = max(self.late, time.monotonic() - due)
        for publisher in self.topics.values():
            if publisher.qos_profile.reliability == ReliabilityPolicy.RELIABLE:
                publisher.wait_for_all_acked(self._patience)

    def _span(self, bag: Bag) -> tuple[int, int | None]:
        """Return the first and the last time of the recording that are played, in nanoseconds."""
        options = self._options
        since = bag.summary().start + int(options.start_offset * _NANOSECONDS)
        ends = [
            None
            if options.playback_duration is None
            else since + int(options.playback_duration * _NANOSECONDS),
            None if options.playback_until_sec is None else int(options.playback_until_sec * _NANOSECONDS),
            options.playback_until_nsec,
        ]
        return since, min((end for end in ends if end is not None), default=None)

    def _wait(self, pace: Pace, recorded: int) -> None:
        """Wait until a time of the recording has come, and heed the keys; what comes late is late from then on."""
        while True:
            now = time.monotonic()
            for key in self._keys.pressed() if self._keys else ():
                if key == "right" and pace.paused:
                    pace.step(recorded, now)
                    return
                self._heed(key, pace, now)
            due = pace.due(recorded)
            left = _LOOK if due is None else min(due - now, _LOOK)
            self._graph.pause(max(left, 0.0))
            if left <= 0:
                return

    def _heed(self, key: str, pace: Pace, now: float) -> None:
        if key == " ":
            pace.pause(now, paused=not pace.paused)
        elif key in ("up", "down"):
            pace.quicken(_QUICKER if key == "up" else 1 / _QUICKER, now)
            warn(f"rate {pace.rate:.3g}")

    def _send(self, recorded: int, message: Recorded | None) -> None:
        """Publish a message, or the time of the recording."""
        if message is None:
            self._clock.publish(Clock(clock=Time(nanoseconds=recorded).to_msg()))
        else:
            self.topics[message.topic].publish(message.data)
            self.count += 1


def _hearers(seen: System, publisher: Any) -> int:  # noqa: ANN401 - of an untyped package
    """Return how many subscriptions get what a publisher offers."""
    topic = publisher.topic_name
    own = End(topic, "", "", "", "", data_of(publisher.qos_profile))
    return sum(end.topic == topic and not mismatch(own, end) for end in seen.subscriptions)


def _remapped(rules: Sequence[str]) -> dict[str, str]:
    """Return the new names of topics by the old ones. Raises `UsageError`."""
    found = {}
    for rule in rules:
        old, separator, new = rule.partition(":=")
        if not (old and separator and new):
            raise UsageError(f"'{rule}' is no remapping as /old:=/new")
        found[absolute(old)] = absolute(new)
    return found
