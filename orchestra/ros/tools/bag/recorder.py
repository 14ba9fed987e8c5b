"""Subscribes to what is chosen as it comes to be there, and hands over to a bag what is heard."""

from __future__ import annotations

import os
import sys
import time
from typing import TYPE_CHECKING, Any, Final

from orchestra.cli.interfaces.index import Interfaces
from orchestra.errors import OrchestraError
from orchestra.fields import replace
from orchestra.ros.tools.bag.classes import recorded_class
from orchestra.ros.tools.bag.definitions import definition
from orchestra.ros.tools.bag.selection import EVENTS
from orchestra.ros.tools.bag.simulated import simulated_time
from orchestra.ros.tools.bag.summary import Topic
from orchestra.ros.tools.bag.taking import Tap
from orchestra.ros.tools.graph.names import topics
from orchestra.ros.tools.graph.qos import data_of
from orchestra.ros.tools.telling import as_json, warn

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Mapping, Sequence

    from rclpy.qos import QoSProfile

    from orchestra.ros.tools.bag.selection import Selection
    from orchestra.ros.tools.bag.storing import Message
    from orchestra.ros.tools.bag.summary import Summary
    from orchestra.ros.tools.bag.writing import BagWriter
    from orchestra.ros.tools.graph.joining import Graph
    from orchestra.ros.tools.keyboard import Keyboard

# How often, in seconds, messages are taken, and known topics are looked at for new publishers.
_TAKE, _FOLLOW = 0.005, 1.0
_SOON: Final = 2.0  # s, after which names that nobody publishes are taken for mistakes
_MILLISECONDS: Final = 1000


class Recorder:
    """What is recorded by now; `lost` messages could not be delivered."""

    def __init__(
        self,
        graph: Graph,
        writer: BagWriter,
        chosen: Selection,
        profiles: Mapping[str, QoSProfile],
        options: Namespace,
    ) -> None:
        self.lost = 0
        self.paused = bool(options.start_paused)
        self._graph = graph
        self._writer = writer
        self._chosen = chosen
        self._profiles = profiles
        self._options = options
        self._taps: dict[str, Tap] = {}
        self._known: dict[str, Topic] = {}
        self._refused: set[str] = set()
        self._seen: set[str] = set()
        self._hinted = False
        self._interfaces = Interfaces(os.environ)
        self._clock = simulated_time(graph.node) if options.clock_time else None

    def missing(self) -> list[tuple[str, str]]:
        """Return the names that are wanted and of which nothing was recorded, and what is to be said of each."""
        return self._chosen.missing(self._taps, self._seen)

    @property
    def timeless(self) -> bool:
        """Tell whether /clock was to tell the time and has not."""
        return self._clock is not None and not self._clock.told

    def record(self, until: float | None, keys: Keyboard | None) -> None:
        """Take and look around until the time has come; signals end it too."""
        look = follow = 0.0
        soon = time.monotonic() + _SOON
        self._say(f"recording to {self._writer.folder}; {'space pauses, ' if keys else ''}Ctrl-C ends it\n")
        while until is None or time.monotonic() < until:
            now = time.monotonic()
            if now >= look and (not self._taps or not self._options.no_discovery):
                look = now + self._options.polling_interval / _MILLISECONDS
                self._look()
            if now >= soon and not self._hinted:
                self._hint()
            if now >= follow:
                follow = now + _FOLLOW
                self._follow()
            for _ in range(keys.pressed().count(" ") if keys else 0):
                self._pause()
            if not self._writer.behind:  # else the middleware keeps it
                self.take()
            self._graph.pause(_TAKE)

    def take(self) -> None:
        """Hand over what has come, in the order in which it came."""
        self._add([message for tap in self._taps.values() for message in tap.take()])

    def close(self) -> Summary:
        """Take nothing more, and end the bag. Raises `OSError`."""
        for tap in self._taps.values():
            tap.close()
        if self._clock is not None:
            self._clock.close()
        for topic in self._known.values():
            self._writer.learn(topic)
        return self._writer.close()

    def _add(self, messages: list[Message]) -> None:
        messages.sort(key=lambda message: message[1])
        if self._clock is not None:
            messages = self._clock.stamped(messages)
        if messages and not self.paused:
            self._writer.add(messages)

    def _pause(self) -> None:
        self.take()
        self.paused = not self.paused
        self._say("paused\n" if self.paused else "recording again\n")

    def _hint(self) -> None:
        """Tell of names that nobody publishes, where another is probably meant: they are waited for all the same."""
        self._hinted = True
        for name, hint in self.missing():
            if hint:
                warn(f"warning: nobody publishes {name} so far{hint}")

    def _look(self) -> None:
        """Subscribe to topics that somebody publishes now."""
        for name, types in topics(self._graph):
            self._seen.add(name)
            if name in self._taps or name in self._refused or not self._chosen.takes(name, types[0]):
                continue
            publishers = self._publishers(name)
            if len(types) > 1:
                self._refuse(name, f"it has more than one type: {', '.join(types)}")
            elif self._is_wanted(name, publishers):
                self._subscribe(name, types[0], publishers)

    def _is_wanted(self, name: str, publishers: Sequence[Any]) -> bool:
        if self._options.ignore_leaf_topics and not self._hearers(name):
            return False
        if publishers:
            return True
        return bool(self._options.include_unpublished_topics and self._hearers(name))

    def _subscribe(self, name: str, type_name: str, publishers: Sequence[Any]) -> None:
        try:
            kind = recorded_class(type_name)
        except OrchestraError as error:
            self._refuse(name, str(error))
            return
        ends = publishers or self._hearers(name)
        # rosbags holds hashes against definitions, opens no bag where it cannot, and knows no events of services.
        identity = "" if name.endswith(EVENTS) else str(ends[0].topic_type_hash)
        self._known[name] = Topic(name, type_name, identity, _offered(publishers))
        self._writer.declare(self._known[name], definition(type_name, self._interfaces.text))
        self._taps[name] = Tap(self._graph.node, name, kind, publishers, self._lose, self._profiles.get(name))
        self._say(f"+ {name} [{type_name}]\n")
        self._note(name)

    def _follow(self) -> None:
        """Hear those who have begun to publish on topics that are recorded already."""
        there = {name: self._publishers(name) for name in self._taps}
        for name, tap in self._taps.items():
            tap.meet(there[name])
        self._graph.spin(0.0)  # what was lost is heard
        for name, tap in self._taps.items():
            publishers = there[name]
            known = self._known[name]
            offers = tuple(one for one in _offered(publishers) if one not in known.profiles)
            if offers:
                self._known[name] = replace(known, profiles=known.profiles + offers)
                self._add(tap.follow(publishers))
                self._note(name)

    def _publishers(self, name: str) -> list[Any]:
        return self._others(self._graph.node.get_publishers_info_by_topic(name))

    def _hearers(self, name: str) -> list[Any]:
        return self._others(self._graph.node.get_subscriptions_info_by_topic(name))

    def _others(self, ends: Sequence[Any]) -> list[Any]:
        ours = self._graph.node.get_name()
        return [one for one in ends if one.node_name != ours]

    def _refuse(self, name: str, why: str) -> None:
        self._refused.add(name)
        warn(f"warning: {name} is not recorded: {why}")

    def _note(self, name: str) -> None:
        for note in self._taps[name].notes:
            warn(f"{name}: {note}")

    def _lose(self, count: int) -> None:
        self.lost += count

    def _say(self, text: str) -> None:
        if not as_json(self._options):
            sys.stdout.write(text)
            sys.stdout.flush()


def _offered(publishers: Sequence[Any]) -> tuple[dict[str, Any], ...]:
    """Return the different profiles of publishers, as plain data."""
    found: list[dict[str, Any]] = []
    for one in publishers:
        if (profile := data_of(one.qos_profile)) not in found:
            found.append(profile)
    return tuple(found)
