"""Which topics are meant: by name, by type, by regular expression, or all; less those that are left out.

What a service tells of its requests and responses stands on a hidden topic; it is meant where the service is.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.errors import UsageError
from orchestra.nearest import nearest
from orchestra.ros.tools.graph.names import absolute, hidden

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Iterable

EVENTS: Final = "/_service_event"


@dataclass(frozen=True, slots=True)
class Selection:
    """The names, types and patterns of a command line.

    `topics` and `services` tell whether all of them are meant, `hidden` whether hidden topics are among them.
    """

    names: frozenset[str]
    types: frozenset[str]
    pattern: re.Pattern[str] | None
    without: frozenset[str]
    without_types: frozenset[str]
    without_pattern: re.Pattern[str] | None
    topics: bool
    services: bool
    hidden: bool

    def takes(self, topic: str, kind: str = "") -> bool:
        """Tell whether a topic of a type is meant. Whoever names a hidden one means it."""
        if topic in self.without or kind in self.without_types:
            return False
        if self.without_pattern and self.without_pattern.search(_told(topic)):
            return False
        if topic in self.names:
            return True
        if topic.endswith(EVENTS):
            return self.services or self._matches(topic)
        if hidden(topic) and not self.hidden:
            return False
        return self.topics or kind in self.types or self._matches(topic)

    def missing(self, topics: Iterable[str], others: Iterable[str] = ()) -> list[tuple[str, str]]:
        """Return each name that is none of these topics, and what is to be said of one that is probably meant."""
        there = {_told(topic) for topic in topics}
        wanted = sorted({_told(name) for name in self.names} - there)
        known = there.union(others)
        near = {name: None if name in known else nearest(name, known) for name in wanted}
        return [(name, f"; did you mean {near[name]}?" if near[name] else "") for name in wanted]

    def _matches(self, topic: str) -> bool:
        return self.pattern is not None and self.pattern.search(_told(topic)) is not None


def selection(options: Namespace, *, default: bool = False) -> Selection:
    """Return what the options say; where they say nothing, `default` means all. Raises `UsageError`."""
    services = [f"{absolute(name)}{EVENTS}" for name in options.services]
    names = frozenset([*_names((*options.names, *options.topics)), *services])
    said = names or options.topic_types or options.regex or options.all_topics or options.all_services
    every = options.all or (default and not said)
    named = not (options.all or options.all_topics or options.all_services)  # these count for more
    return Selection(
        names if named else frozenset(services),
        frozenset(options.topic_types),
        _compiled(options.regex) if named else None,
        frozenset(
            [
                *_names(options.exclude_topics),
                *(f"{absolute(one)}{EVENTS}" for one in options.exclude_services),
            ]
        ),
        frozenset(options.exclude_topic_types),
        _compiled(options.exclude_regex),
        topics=every or options.all_topics,
        services=every or options.all_services,
        hidden=options.include_hidden_topics,
    )


def _told(topic: str) -> str:
    """Return what expressions are held against: the name of a service stands for its events."""
    return topic.removesuffix(EVENTS)


def _names(given: Iterable[str]) -> list[str]:
    return [absolute(name) for name in given]


def _compiled(text: str | None) -> re.Pattern[str] | None:
    try:
        return None if text is None else re.compile(text)
    except re.error as error:
        raise UsageError(f"'{text}' is no regular expression: {error}") from None
