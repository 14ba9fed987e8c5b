"""What every loader makes of a file before the models see it: scalars, mappings and lists that know their place."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from collections.abc import Set as AbstractSet
from typing import Any

from orchestra.dataclass import dataclass
from orchestra.location import Span, inside, stretches


@dataclass(slots=True)
class Written:
    """A scalar. `spans` gives the place of a part of the text by code point offsets; `null` is an empty value.

    It is not frozen, for a file has thousands, and a frozen one takes three times as long to make.
    """

    text: str
    span: Span
    spans: Callable[[int, int], Span]
    quoted: bool = False
    null: bool = False

    @property
    def inside(self) -> Span:
        """The place of the text without the quotes of the format."""
        return self.spans(0, len(self.text))


class Verbatim(Written):
    """A scalar that stands in the file as it reads; its span is one of offsets, with the quotes where it has some."""

    __slots__ = ()

    def __init__(self, text: str, span: Span, quoted: bool = False, null: bool = False) -> None:
        self.text = text
        self.span = span
        self.quoted = quoted
        self.null = null

    @property
    def spans(self) -> Callable[[int, int], Span]:  # type: ignore[override] # nobody sets it
        """What gives the place of a part of the text."""
        return stretches(self.span, self.quoted)

    @property
    def inside(self) -> Span:
        """The place of the text without the quotes of the format."""
        return inside(self.span, 1, len(self.text) + 1) if self.quoted else self.span


class Keyed(dict[str, Any]):
    """A mapping, its keys as written; `head` is the place of what introduces the mapping.

    `lossy` tells that a key has been reported and left out; `meant` are the keys that such ones probably mean. `read`
    is what a model has made of the mapping. `again` are keys that stand here once more, with what is behind them.
    """

    __slots__ = ("_keys_at", "_later", "again", "head", "lossy", "meant", "read", "span")

    def __init__(self, span: Span, head: Span, values: dict[str, Any] | tuple[()] = ()) -> None:
        super().__init__(values)
        self.span = span
        self.head = head
        self._keys_at: dict[str, Span] = {}
        self._later: Callable[[], dict[str, Span]] | None = None
        self.lossy = False
        self.meant: AbstractSet[str] = frozenset()
        self.read: Any = None
        self.again: tuple[tuple[str, Any, Span], ...] = ()

    @property
    def keys_at(self) -> dict[str, Span]:
        """The place of each key."""
        if self._later is not None:
            self._keys_at = self._later()
            self._later = None
        return self._keys_at

    @keys_at.setter
    def keys_at(self, places: dict[str, Span]) -> None:
        self._keys_at, self._later = places, None

    def place_later(self, places: Callable[[], dict[str, Span]]) -> None:
        """Let the places of the keys be worked out when the first is asked for."""
        self._later = places

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
