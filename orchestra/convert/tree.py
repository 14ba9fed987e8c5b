"""What is written in YAML and XML, before it is text: scalars, lists and mappings with the comments beside them."""

from __future__ import annotations

from enum import Enum, auto
from typing import TYPE_CHECKING, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.location import Span

if TYPE_CHECKING:
    from collections.abc import Iterable


@dataclass(frozen=True, slots=True)
class Notes:
    """Comments in the lines before something, and the one at the end of its line."""

    before: tuple[str, ...] = ()
    beside: str = ""


NONE = Notes()


class Style(Enum):
    """How a scalar is to be written."""

    PLAIN = auto()  # without quotes: its looks matter
    QUOTED = auto()  # in quotes, so that it is a text
    TEXT = auto()  # as a reader expects a text


@dataclass(frozen=True, slots=True)
class Scalar:
    """A text by the grammar of the launch language; `span` is the place that it comes from."""

    text: str
    style: Style
    span: Span


@dataclass(frozen=True, slots=True)
class Item:
    """One item of a list."""

    node: Node
    notes: Notes = NONE


@dataclass(frozen=True, slots=True)
class Sequence:
    """A list; `free` where a single item stands for a list of it alone, and any list may stand in brackets in XML."""

    items: tuple[Item, ...]
    free: bool = False


@dataclass(frozen=True, slots=True)
class Entry:
    """A key of a mapping with its value; without a value only the comments are there."""

    key: str
    node: Node
    notes: Notes = NONE


@dataclass(frozen=True, slots=True)
class Mapping:
    """A mapping; `variables` where its keys are names of the user's choice."""

    entries: tuple[Entry, ...]
    variables: bool = False


Node: TypeAlias = Scalar | Sequence | Mapping


@dataclass(frozen=True, slots=True)
class Document:
    """A whole file: the comments at its top and at its end, and its actions."""

    actions: Sequence
    deprecated: Scalar | None = None
    header: tuple[str, ...] = ()
    closing: tuple[str, ...] = field(default=())


def listed(nodes: Iterable[Node]) -> tuple[Item, ...]:
    """Return nodes as items without comments."""
    return tuple(Item(node) for node in nodes)
