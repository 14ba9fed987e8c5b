"""YAML as written: a tree of nodes with their places, and the comments between them.

Rejected: ruamel.yaml. It reads the text into values and writes these, so long texts are folded anew, comments move to
the neighbours of what they stood beside, and parameter files with a key twice, which rcl merges, lose one of them. Here
libyaml, which the loader and rcl read with, tells where every scalar begins and ends, and its text is taken over as it
stands; only what is between scalars is laid out.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.formatting.refusal import NotFormatted
from orchestra.formatting.yaml_comments import comments_between
from orchestra.formatting.yaml_nodes import Document, File, Mapping, Node, Scalar, Sequence
from orchestra.formatting.yaml_scalars import block_end
from orchestra.pyyaml import yaml

LOADER: type[Any] = getattr(yaml, "CBaseLoader", yaml.BaseLoader)

# To their types events may be without marks; those of a parser have them.
_Event: TypeAlias = Any

_DEEPEST = 100
_PROPERTIES = re.compile(r"[&!]\S*(?:[ \t]+[&!]\S*)*")


def parsed(text: str) -> File:
    """Return the tree of a text with line feeds alone. Raises `yaml.YAMLError`, and `NotFormatted`."""
    builder = _Builder(text, yaml.parse(text, Loader=LOADER))
    documents = tuple(builder.documents())
    comments, marks = comments_between(text, builder.taken)
    if "?" in marks:
        raise NotFormatted("it has a key behind a question mark")
    return File(text, documents, comments, builder.ends_in_text)


@dataclass(slots=True)
class _Builder:
    """Builds the tree event by event; `taken` are the stretches of the text that are no gaps."""

    text: str
    events: Iterator[Any]
    taken: list[tuple[int, int]] = field(default_factory=list)
    depth: int = 0
    ends_in_text: bool = False

    def documents(self) -> Iterator[Document]:
        for event in self.events:
            if isinstance(event, yaml.DocumentStartEvent):
                yield self.document(event)

    def document(self, begin: _Event) -> Document:
        if begin.tags:
            raise NotFormatted("it has a directive '%TAG'")
        root = self.node(next(self.events))
        end = next(self.events)
        ended = self.text.find("...", end.start_mark.index, end.end_mark.index) if end.explicit else -1
        return Document(
            root,
            begin.start_mark.index if begin.version else None,
            begin.end_mark.index - len("---") if begin.explicit else None,
            ended if ended >= 0 else None,
        )

    def node(self, event: _Event) -> Node:
        if isinstance(event, yaml.ScalarEvent | yaml.AliasEvent):
            return self.scalar(event)
        self.depth += 1
        if self.depth > _DEEPEST:
            raise NotFormatted(f"it nests more than {_DEEPEST} deep")
        build = self.sequence if isinstance(event, yaml.SequenceStartEvent) else self.mapping
        node = build(event)
        self.depth -= 1
        return node

    def scalar(self, event: _Event) -> Scalar:
        start, end = event.start_mark.index, event.end_mark.index
        style = getattr(event, "style", None)
        if style in ("|", ">"):  # its end is that of the empty lines below it
            end = block_end(self.text, start, end, event.value)
            self.ends_in_text = end == len(self.text) and not event.value.endswith("\n")
        if end > start:
            self.taken.append((start, end))
        return Scalar(start, end, getattr(event, "value", "*"), style)

    def opened(self, event: _Event) -> str:
        """Return tag and anchor of a collection, and take its beginning."""
        start = event.start_mark.index
        found = _PROPERTIES.match(self.text, start)
        if found is not None:
            self.taken.append((start, found.end()))
        if event.flow_style and event.end_mark.index > start:
            self.taken.append((event.end_mark.index - 1, event.end_mark.index))
        return found[0] if found is not None else ""

    def closed(self, event: _Event, last: int, *, flow: bool) -> int:
        """Return where a collection ends, and take the bracket."""
        if not flow:
            return last
        start, end = event.start_mark.index, event.end_mark.index
        if end > start:
            self.taken.append((start, end))
        return int(max(end, last))

    def sequence(self, event: _Event) -> Sequence:
        properties = self.opened(event)
        items: list[Node] = []
        last = event.start_mark.index
        while not isinstance(inner := next(self.events), yaml.SequenceEndEvent):
            items.append(self.node(inner))
            last = items[-1].end
        end = self.closed(inner, last, flow=bool(event.flow_style))
        return Sequence(event.start_mark.index, end, properties, bool(event.flow_style), tuple(items))

    def mapping(self, event: _Event) -> Mapping:
        properties = self.opened(event)
        flow = bool(event.flow_style)
        pairs: list[tuple[Scalar, Node]] = []
        last = event.start_mark.index
        while not isinstance(inner := next(self.events), yaml.MappingEndEvent):
            key = self.node(inner)
            if not isinstance(key, Scalar) or "\n" in self.text[key.start : key.end]:
                raise NotFormatted("it has a key that is no word")
            value = self.node(next(self.events))
            pairs.append((key, value))
            last = max(value.end, key.end)
        braces = flow and event.end_mark.index > event.start_mark.index
        end = self.closed(inner, last, flow=flow)
        return Mapping(event.start_mark.index, end, properties, flow, tuple(pairs), braces)
