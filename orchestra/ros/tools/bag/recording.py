"""`bag record`."""

from __future__ import annotations

import os
import sys
import time
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from orchestra.cli.interfaces.index import Interfaces
from orchestra.errors import OrchestraError, RunError, UsageError
from orchestra.fields import replace
from orchestra.ros.tools.bag.definitions import definition
from orchestra.ros.tools.bag.selection import selection
from orchestra.ros.tools.bag.summary import Topic
from orchestra.ros.tools.bag.taking import Tap
from orchestra.ros.tools.bag.writing import BagWriter, Layout
from orchestra.ros.tools.graph.joining import joined
from orchestra.ros.tools.graph.names import topics
from orchestra.ros.tools.graph.qos import data_of
from orchestra.ros.tools.messages.types import message_class
from orchestra.ros.tools.telling import as_json, tell, warn

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Sequence

    from orchestra.ros.tools.bag.selection import Selection
    from orchestra.ros.tools.bag.storing import Message
    from orchestra.ros.tools.bag.summary import Summary
    from orchestra.ros.tools.graph.joining import Graph

# How often messages are taken, the graph is looked at for new topics, and known ones for new publishers; in seconds.
_TAKE, _LOOK, _FOLLOW = 0.005, 0.1, 1.0
_FAILED: Final = 1
_NANOSECONDS: Final = 1e9


def record(options: Namespace) -> int:
    """Record until Ctrl-C, SIGTERM or the given time; all of them are a good end."""
    chosen = selection(options)
    if not (options.all or options.names or options.topics or options.regex):
        raise UsageError("say which topics: names, --regex RE or --all")
    folder = Path(options.output or time.strftime("rosbag2_%Y_%m_%d-%H_%M_%S"))
    if folder.exists():
        raise RunError(f"{folder} is there already")
    with joined(options) as graph:
        layout = Layout(
            options.compression, options.max_bag_size, int(options.max_bag_duration * _NANOSECONDS)
        )
        writer = BagWriter(folder, layout, f"orchestra {version('orchestra')}")
        recorder = _Recorder(graph, writer, chosen, quiet=as_json(options))
        began = time.monotonic()
        try:
            recorder.record(None if options.duration is None else began + options.duration, options)
        except (KeyboardInterrupt, SystemExit):
            recorder.take()
        finally:
            told = recorder.close()
    missing = [name for name in sorted(chosen.names) if not recorder.has(name)]
    for name in missing:
        warn(f"warning: nothing was recorded of {name}: nobody published it")
    if recorder.lost:
        warn(f"warning: {recorder.lost} messages were lost before they could be recorded")
    tell(options, _text(folder, told), _data(folder, told, recorder.lost))
    return _FAILED if recorder.lost else 0


class _Recorder:
    """Subscribes to what is chosen as it comes to be there, and hands over what is heard."""

    def __init__(self, graph: Graph, writer: BagWriter, chosen: Selection, *, quiet: bool) -> None:
        self.lost = 0
        self._graph = graph
        self._writer = writer
        self._chosen = chosen
        self._quiet = quiet
        self._taps: dict[str, Tap] = {}
        self._known: dict[str, Topic] = {}
        self._refused: set[str] = set()
        self._interfaces = Interfaces(os.environ)

    def has(self, name: str) -> bool:
        """Tell whether a topic has been recorded."""
        return name in self._taps

    def record(self, until: float | None, options: Namespace) -> None:
        """Take and look around until the time has come; signals end it too."""
        look = follow = 0.0
        self._say(f"recording to {self._writer.folder}; Ctrl-C ends it\n")
        while until is None or time.monotonic() < until:
            now = time.monotonic()
            if now >= look and (not self._taps or not options.no_discovery):
                look = now + _LOOK
                self._look()
            if now >= follow:
                follow = now + _FOLLOW
                self._follow()
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
        for topic in self._known.values():
            self._writer.learn(topic)
        return self._writer.close()

    def _add(self, messages: list[Message]) -> None:
        if messages:
            self._writer.add(sorted(messages, key=lambda message: message[1]))

    def _look(self) -> None:
        """Subscribe to topics that somebody publishes now."""
        for name, types in topics(self._graph):
            if name in self._taps or name in self._refused or not self._chosen.takes(name):
                continue
            publishers = self._publishers(name)
            if len(types) > 1:
                self._refuse(name, f"it has more than one type: {', '.join(types)}")
            elif publishers:
                self._subscribe(name, types[0], publishers)

    def _subscribe(self, name: str, type_name: str, publishers: Sequence[Any]) -> None:
        try:
            kind = message_class(type_name)
        except OrchestraError as error:
            self._refuse(name, str(error))
            return
        self._known[name] = Topic(name, type_name, str(publishers[0].topic_type_hash), _offered(publishers))
        self._writer.declare(self._known[name], definition(type_name, self._interfaces.text))
        self._taps[name] = Tap(self._graph.node, name, kind, publishers, self._lose)
        self._say(f"+ {name} [{type_name}]\n")
        self._note(name)

    def _follow(self) -> None:
        """Hear those who have begun to publish on topics that are recorded already."""
        self._graph.spin(0.0)  # what was lost is heard
        for name, tap in self._taps.items():
            publishers = self._publishers(name)
            known = self._known[name]
            offers = tuple(one for one in _offered(publishers) if one not in known.profiles)
            if offers:
                self._known[name] = replace(known, profiles=known.profiles + offers)
                self._add(tap.follow(publishers))
                self._note(name)

    def _publishers(self, name: str) -> list[Any]:
        ours = self._graph.node.get_name()
        found = self._graph.node.get_publishers_info_by_topic(name)
        return [one for one in found if one.node_name != ours]

    def _refuse(self, name: str, why: str) -> None:
        self._refused.add(name)
        warn(f"warning: {name} is not recorded: {why}")

    def _note(self, name: str) -> None:
        for note in self._taps[name].notes:
            warn(f"{name}: {note}")

    def _lose(self, count: int) -> None:
        self.lost += count

    def _say(self, text: str) -> None:
        if not self._quiet:
            sys.stdout.write(text)
            sys.stdout.flush()


def _offered(publishers: Sequence[Any]) -> tuple[dict[str, Any], ...]:
    """Return the different profiles of publishers, as plain data."""
    found: list[dict[str, Any]] = []
    for one in publishers:
        if (profile := data_of(one.qos_profile)) not in found:
            found.append(profile)
    return tuple(found)


def _text(folder: Path, told: Summary) -> str:
    seconds = (told.end - told.start) / _NANOSECONDS
    return f"{told.count} messages of {len(told.topics)} topics in {seconds:.1f} s: {folder}\n"


def _data(folder: Path, told: Summary, lost: int) -> dict[str, Any]:
    return {
        "path": str(folder),
        "messages": told.count,
        "lost": lost,
        "start": told.start,
        "end": told.end,
        "topics": {topic.name: topic.count for topic in told.topics},
    }
