"""YAML launch files as nearly all of them are, read in one pass over the events of PyYAML's C parser.

Composing nodes first takes twice as long as the events alone. What calls for a second look (aliases, tags, merges, a
key that stands twice, whatever is wrong) is left to `yaml_file`, which gives the same tree for what can be read here.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.description.source import Keyed, Listed, Verbatim, Written
from orchestra.load.offsets import spans_of
from orchestra.location import inside, stretch
from orchestra.patterns import pattern
from orchestra.pyyaml import yaml

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.load.offsets import Source
    from orchestra.location import Span

NULL: Final = frozenset({"", "~", "null", "Null", "NULL"})
# What looks like a key and is an item of a list without its blank.
DASH: Final = pattern(r"-[A-Za-z]")
DEEPEST: Final = 100
DocumentEndEvent: Final = yaml.DocumentEndEvent
DocumentStartEvent: Final = yaml.DocumentStartEvent
MappingEndEvent: Final = yaml.MappingEndEvent
MappingStartEvent: Final = yaml.MappingStartEvent
ScalarEvent: Final = yaml.ScalarEvent
SequenceEndEvent: Final = yaml.SequenceEndEvent
SequenceStartEvent: Final = yaml.SequenceStartEvent
StreamEndEvent: Final = yaml.StreamEndEvent

PARSER: Final[type[Any]] = getattr(yaml, "CBaseLoader", yaml.BaseLoader)

# What the keys of merges and of mistaken items begin with; what a comma has cut off a substitution ends with a bracket.
_ODD: Final = frozenset({"<", "-"})


class _NotPlainError(Exception):
    """Something is in the file that cannot be told from one event alone."""


def read(whole: Source) -> Any | None:  # noqa: ANN401 - a tree
    """Return the tree of a text, None where it is not plain, be it right or wrong."""
    try:
        parser = PARSER(whole.text)
        return _Events(whole, parser.get_event).document()
    except (_NotPlainError, yaml.YAMLError):
        return None


def read_part(whole: Source, begin: int, end: int, depth: int) -> Any | None:  # noqa: ANN401 - a tree
    """Return the tree of what stands between two offsets, so deep in a file, if it is a whole value; None as `read`."""
    try:
        parser = PARSER(whole.text[begin:end])
        return _Events(whole, parser.get_event, begin).document(depth, part=True)
    except (_NotPlainError, yaml.YAMLError):
        return None


class _Events:
    """Reads on from an event; `following` gives the next one. Their text begins at the offset `first` of the whole."""

    __slots__ = ("first", "following", "marked", "text", "whole")

    def __init__(self, whole: Source, following: Callable[[], Any], first: int = 0) -> None:
        self.whole = whole
        self.first = first
        self.text = whole.text
        self.following = following
        self.marked = any(map(whole.text.__contains__, "&*!"))  # there may be anchors or tags

    def document(self, depth: int = 1, *, part: bool = False) -> Any:  # noqa: ANN401 - a tree
        """Return the tree of the one document that there is; what ends one ends no `part` of a document."""
        self.following()  # the stream begins
        self.expect(DocumentStartEvent)
        tree = self.value(self.following(), None, depth)
        end = self.following()
        if type(end) is not DocumentEndEvent or (part and end.explicit):
            raise _NotPlainError
        self.expect(StreamEndEvent)
        return tree

    def expect(self, kind: type[Any]) -> None:
        if type(self.following()) is not kind:
            raise _NotPlainError

    def value(self, event: Any, key: Any, depth: int) -> Any:  # noqa: ANN401 - events, a tree
        """Return the tree that begins with an event; `key` is that of the key before it, None where there is none."""
        kind = type(event)
        if kind is MappingStartEvent and depth <= DEEPEST:
            return self.mapping(event, key, depth)
        if kind is SequenceStartEvent and depth <= DEEPEST:
            return self.sequence(event, depth)
        if kind is ScalarEvent:
            return self.scalar(event)
        raise _NotPlainError

    def scalar(self, event: Any) -> Written:  # noqa: ANN401 - an event
        if self.marked and (event.anchor is not None or event.tag is not None):
            raise _NotPlainError
        text, style = event.value, event.style
        first = self.first
        begin, end = event.start_mark.index + first, event.end_mark.index + first
        span = stretch(self.whole, begin, end)
        if not style:
            if self.text[begin:end] == text:
                return Verbatim(text, span, False, text in NULL)
        elif self.text[begin + 1 : end - 1] == text:
            return Verbatim(text, span, True)
        spans = spans_of(self.whole, begin, end, text, style)
        return Written(text, span, spans, quoted=bool(style), null=not style and text in NULL)

    def sequence(self, start: Any, depth: int) -> Listed:  # noqa: ANN401 - an event
        self.check(start)
        following = self.following
        items = []
        event = following()
        while (kind := type(event)) is not SequenceEndEvent:
            items.append(self.scalar(event) if kind is ScalarEvent else self.value(event, None, depth + 1))
            event = following()
        listed = Listed(self.between(start, event))
        listed += items
        return listed

    def mapping(self, start: Any, key: Any, depth: int) -> Keyed:  # noqa: ANN401 - events
        if self.marked:
            self.check(start)
        following = self.following
        found: dict[str, Any] = {}
        keys: list[Any] = []
        event = following()
        while (kind := type(event)) is ScalarEvent:
            name: str = event.value
            if name in found or name[:1] in _ODD or name[-1:] == ")":
                raise _NotPlainError
            if self.marked:
                self.check(event)
            keys.append(event)
            value = following()
            if type(value) is ScalarEvent:
                found[name] = self.scalar(value)
            else:
                found[name] = self.value(value, event, depth + 1)
            event = following()
        if kind is not MappingEndEvent:
            raise _NotPlainError
        span = self.between(start, event)
        if key is None and keys and not start.flow_style:
            key = keys[0]
        head = inside(span, 0, 1) if key is None else self.between(key, key)
        mapping = Keyed(span, head, found)
        mapping.place_later(
            lambda: {name: self.between(mark, mark) for name, mark in zip(found, keys, strict=True)}
        )
        return mapping

    def check(self, event: Any) -> None:  # noqa: ANN401 - an event
        """Refuse what has an anchor or a tag."""
        if event.anchor is not None or event.tag is not None:
            raise _NotPlainError

    def between(self, first: Any, last: Any) -> Span:  # noqa: ANN401 - events
        """Return the place from where one event begins to where another one ends."""
        before = self.first
        return stretch(self.whole, first.start_mark.index + before, last.end_mark.index + before)
