"""YAML launch files as nearly all of them are, read in one pass over the events of PyYAML's C parser.

Composing nodes first takes twice as long as the events alone. What calls for a second look (aliases, tags, merges, a
key that stands twice, whatever is wrong) is left to `yaml_file`, which gives the same tree for what can be read here.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final

import yaml
from yaml.events import (
    DocumentEndEvent,
    DocumentStartEvent,
    MappingEndEvent,
    MappingStartEvent,
    ScalarEvent,
    SequenceEndEvent,
    SequenceStartEvent,
    StreamEndEvent,
)

from orchestra.description.source import Keyed, Listed, Verbatim, Written
from orchestra.load.offsets import spans_of
from orchestra.location import stretch

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.load.offsets import Source
    from orchestra.location import Span

NULL: Final = frozenset({"", "~", "null", "Null", "NULL"})
# What looks like a key and is an item of a list without its blank.
DASH: Final = re.compile(r"-[A-Za-z]")
DEEPEST: Final = 100
PARSER: Final[type[Any]] = getattr(yaml, "CBaseLoader", yaml.BaseLoader)

_MERGE: Final = "<<"
_STARTS: Final = (MappingStartEvent, SequenceStartEvent)


class _NotPlainError(Exception):
    """Something is in the file that cannot be told from one event alone."""


def read(whole: Source) -> Any | None:  # noqa: ANN401 - a tree
    """Return the tree of a text, None where it is not plain, be it right or wrong."""
    try:
        parser = PARSER(whole.text)
        return _Events(whole, parser.get_event).document()
    except (_NotPlainError, yaml.YAMLError):
        return None


class _Events:
    """Reads on from an event; `following` gives the next one."""

    __slots__ = ("following", "text", "whole")

    def __init__(self, whole: Source, following: Callable[[], Any]) -> None:
        self.whole = whole
        self.text = whole.text
        self.following = following

    def document(self) -> Any:  # noqa: ANN401 - a tree
        """Return the tree of the one document that there is."""
        self.following()  # the stream begins
        self.expect(DocumentStartEvent)
        tree = self.value(self.following(), None, 1)
        self.expect(DocumentEndEvent)
        self.expect(StreamEndEvent)
        return tree

    def expect(self, kind: type[Any]) -> None:
        if type(self.following()) is not kind:
            raise _NotPlainError

    def value(self, event: Any, head: Span | None, depth: int) -> Any:  # noqa: ANN401 - an event, a tree
        """Return the tree that begins with an event; `head` is the place of the key before it."""
        kind = type(event)
        if kind is ScalarEvent:
            return self.scalar(event)
        reads = self.mapping if kind is MappingStartEvent else self.sequence
        if kind not in _STARTS or event.anchor is not None or event.tag is not None or depth > DEEPEST:
            raise _NotPlainError
        return reads(event, head, depth)

    def scalar(self, event: Any) -> Written:  # noqa: ANN401 - an event
        if event.anchor is not None or event.tag is not None:
            raise _NotPlainError
        text, style = event.value, event.style
        begin, end = event.start_mark.index, event.end_mark.index
        span = stretch(self.whole, begin, end)
        if not style:
            if self.text[begin:end] == text:
                return Verbatim(text, span, self.whole, begin, null=text in NULL)
        elif self.text[begin + 1 : end - 1] == text:
            return Verbatim(text, span, self.whole, begin + 1, quoted=True)
        spans = spans_of(self.whole, begin, end, text, style)
        return Written(text, span, spans, quoted=bool(style), null=not style and text in NULL)

    def sequence(self, start: Any, _head: Span | None, depth: int) -> Listed:  # noqa: ANN401 - an event
        begin = start.start_mark.index
        items = Listed(stretch(self.whole, begin, begin))
        event = self.following()
        while (kind := type(event)) is not SequenceEndEvent:
            items.append(self.scalar(event) if kind is ScalarEvent else self.value(event, None, depth + 1))
            event = self.following()
        items.span = stretch(self.whole, begin, event.end_mark.index)
        return items

    def mapping(self, start: Any, head: Span | None, depth: int) -> Keyed:  # noqa: ANN401 - an event
        whole, following = self.whole, self.following
        begin = start.start_mark.index
        first = stretch(whole, begin, begin + 1)
        mapping = Keyed(first, head or first)
        keys: list[Any] = []
        event = following()
        while (kind := type(event)) is ScalarEvent:
            key: str = event.value
            if key in mapping or key == _MERGE or DASH.match(key):
                raise _NotPlainError
            if event.anchor is not None or event.tag is not None:
                raise _NotPlainError
            keys.append(event)
            value = following()
            if type(value) is ScalarEvent:
                mapping[key] = self.scalar(value)
            else:
                at = _span(whole, event)
                mapping[key] = self.value(value, at, depth + 1)
            event = following()
        if kind is not MappingEndEvent:
            raise _NotPlainError
        mapping.span = stretch(whole, begin, event.end_mark.index)
        mapping.place_later(lambda: {key.value: _span(whole, key) for key in keys})
        if head is None and keys and not start.flow_style:
            mapping.head = _span(whole, keys[0])
        return mapping


def _span(whole: Source, event: Any) -> Span:  # noqa: ANN401 - an event
    return stretch(whole, event.start_mark.index, event.end_mark.index)
