"""What every loader makes of a file before the models see it: scalars, mappings and lists that know their place."""

from __future__ import annotations

from collections.abc import Callable
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
    """A mapping. `keys_at` has the place of each key, `head` the place of what introduces the mapping."""

    __slots__ = ("head", "keys_at", "span")

    def __init__(self, span: Span, head: Span) -> None:
        super().__init__()
        self.span = span
        self.head = head
        self.keys_at: dict[str, Span] = {}


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
    return "a list" if isinstance(value, list) else type(value).__name__


def shortened(text: str, most: int = 40) -> str:
    """Return the text on one line, cut to be read in a message."""
    line = " ".join(text.split())
    return line if len(line) <= most else line[: most - 1] + "…"
