"""What every loader makes of a file before the models see it: scalars, mappings and lists that know their place."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from orchestra.location import Span


@dataclass(frozen=True, slots=True)
class Written:
    """A scalar. `spans` gives the place of a part of the text by code point offsets; `null` is an empty value."""

    text: str
    span: Span
    spans: Callable[[int, int], Span]
    quoted: bool = False
    null: bool = False


class Keyed(dict[str, Any]):
    """A mapping, its keys as written. `keys_at` has the place of each, `head` that of what introduces the mapping.

    `lossy` tells that a key has been reported and left out; `meant` are the keys that such ones probably mean. `read`
    is what a model has made of the mapping.
    """

    __slots__ = ("head", "keys_at", "lossy", "meant", "read", "span")

    def __init__(self, span: Span, head: Span) -> None:
        super().__init__()
        self.span = span
        self.head = head
        self.keys_at: dict[str, Span] = {}
        self.lossy = False
        self.meant: set[str] = set()
        self.read: Any = None

    def put(self, key: str, value: Any, at: Span) -> None:  # noqa: ANN401 - a tree
        """Add a key that is written at a place."""
        self[key] = value
        self.keys_at[key] = at


class Listed(list[Any]):
    """A list."""

    __slots__ = ("span",)

    def __init__(self, span: Span) -> None:
        super().__init__()
        self.span = span


def kind_of(value: object) -> str:
    """Return what a value is, in the user's words."""
    if isinstance(value, Written):
        return "nothing" if value.null else f"'{shortened(value.text)}'"
    if isinstance(value, dict):
        return "a mapping"
    if isinstance(value, list):
        return "a list"
    raw = getattr(value, "raw", None)  # a text of Python code, read already
    return type(value).__name__ if raw is None else f"'{shortened(raw)}'"


def texts_in(tree: Any) -> Iterator[str]:  # noqa: ANN401 - a tree
    """Yield every scalar of a tree."""
    if isinstance(tree, Written):
        yield tree.text
    elif isinstance(tree, dict):
        for value in tree.values():
            yield from texts_in(value)
    elif isinstance(tree, list):
        for value in tree:
            yield from texts_in(value)


def shortened(text: str, most: int = 40) -> str:
    """Return the text on one line, cut to be read in a message."""
    line = " ".join(text.split())
    return line if len(line) <= most else line[: most - 1] + "…"
