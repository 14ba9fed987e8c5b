"""Which topics are meant: by name, by regular expression, or all; less those that are left out."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.errors import UsageError
from orchestra.ros.tools.graph.names import absolute, hidden

if TYPE_CHECKING:
    from argparse import Namespace


@dataclass(frozen=True, slots=True)
class Selection:
    """The names and patterns of a command line; without names and pattern, all topics are meant."""

    names: frozenset[str]
    pattern: re.Pattern[str] | None
    without: frozenset[str]
    without_pattern: re.Pattern[str] | None
    hidden: bool

    def takes(self, topic: str) -> bool:
        """Tell whether a topic is meant. Whoever names a hidden one means it."""
        if topic in self.without or (self.without_pattern and self.without_pattern.search(topic)):
            return False
        if topic in self.names:
            return True
        if hidden(topic) and not self.hidden:
            return False
        if self.pattern is not None:
            return self.pattern.search(topic) is not None
        return not self.names


def selection(options: Namespace) -> Selection:
    """Return what the options say. Raises `UsageError` for what is no regular expression."""
    named = frozenset(absolute(name) for name in (*options.names, *options.topics))
    return Selection(
        frozenset() if options.all else named,
        None if options.all else _compiled(options.regex),
        frozenset(absolute(name) for name in options.exclude_topics),
        _compiled(options.exclude_regex),
        options.include_hidden_topics,
    )


def _compiled(text: str | None) -> re.Pattern[str] | None:
    try:
        return None if text is None else re.compile(text)
    except re.error as error:
        raise UsageError(f"'{text}' is no regular expression: {error}") from None
