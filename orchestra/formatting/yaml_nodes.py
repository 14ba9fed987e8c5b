"""The nodes of a YAML text, with their places in it."""

from __future__ import annotations

from bisect import bisect_left
from operator import attrgetter
from typing import TypeAlias

from orchestra.dataclass import dataclass
from orchestra.formatting.yaml_comments import Comment


@dataclass(frozen=True, slots=True)
class Scalar:
    """A scalar or an alias: the offsets of its text, tag and anchor included, its value and its style."""

    start: int
    end: int
    value: str = ""
    style: str | None = None

    @property
    def empty(self) -> bool:
        """Whether nothing stands there."""
        return self.start == self.end


@dataclass(frozen=True, slots=True)
class Sequence:
    """A list. `properties` are its tag and anchor; `flow` is one in brackets."""

    start: int
    end: int
    properties: str
    flow: bool
    items: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Mapping:
    """A mapping. One in `flow` may be without braces of its own: `[a: 1]`."""

    start: int
    end: int
    properties: str
    flow: bool
    pairs: tuple[tuple[Scalar, Node], ...]
    braces: bool = True


Node: TypeAlias = Scalar | Sequence | Mapping


@dataclass(frozen=True, slots=True)
class Document:
    """One document: the offsets of `%YAML`, `---` and `...` where these are written."""

    root: Node
    directive: int | None
    begun: int | None
    ended: int | None


@dataclass(frozen=True, slots=True)
class File:
    """A file: its text, documents and comments in order.

    One that `ends_in_text` has a block scalar at its end, and no line break: with one the value would be another.
    """

    text: str
    documents: tuple[Document, ...]
    comments: tuple[Comment, ...]
    ends_in_text: bool

    def column(self, offset: int) -> int:
        """Return the column of an offset, from 0, tabs counted to the next multiple of eight."""
        return len(self.text[self.text.rfind("\n", 0, offset) + 1 : offset].expandtabs())

    def breaks_before(self, offset: int) -> int:
        """Return how many line breaks stand right before an offset, blanks aside."""
        begin = offset
        while begin and self.text[begin - 1] in " \t\n":
            begin -= 1
        return self.text.count("\n", begin, offset)

    def comment_in(self, start: int, end: int) -> Comment | None:
        """Return the first comment that begins between two offsets."""
        index = bisect_left(self.comments, start, key=attrgetter("start"))
        found = self.comments[index] if index < len(self.comments) else None
        return found if found is not None and found.start < end else None

    def dash(self, after: int, before: int) -> int:
        """Return the offset of the last dash between two others, outside of comments."""
        at = after
        while (comment := self.comment_in(at, before)) is not None:
            if (dash := self.text.rfind("-", at, comment.start)) >= 0:
                return max(dash, self.dash(comment.end, before))
            at = comment.end
        return self.text.rfind("-", at, before)
