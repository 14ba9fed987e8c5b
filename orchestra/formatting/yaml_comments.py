"""The comments of a YAML text: all that begins with `#` between two scalars."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator


@dataclass(frozen=True, slots=True)
class Comment:
    """A comment: its text from `#` on, its offset, column, and the column at which what stands before it ends.

    `own_line` is one with nothing before it; `follows` one of these that stands right below another one of its column
    that has something before it, and goes on with it.
    """

    text: str
    start: int
    column: int
    behind: int
    own_line: bool
    follows: bool

    @property
    def end(self) -> int:
        """The offset of the end of its line."""
        return self.start + len(self.text)


def comments_between(text: str, taken: Iterable[tuple[int, int]]) -> tuple[tuple[Comment, ...], str]:
    """Return the comments outside of the stretches that are taken, and all other marks there without blanks."""
    found: list[Comment] = []
    marks = []
    for start, end in _gaps(taken, len(text)):
        at = start
        while (begin := text.find("#", at, end)) >= 0:
            marks.append(text[at:begin])
            at = _end_of_line(text, begin)
            found.append(_comment(text, begin, found[-1] if found else None))
        marks.append(text[at:end])
    return tuple(found), "".join("".join(marks).split())


def _gaps(taken: Iterable[tuple[int, int]], length: int) -> Iterator[tuple[int, int]]:
    last = 0
    for start, end in sorted(taken):
        if start > last:
            yield last, start
        last = max(last, end)
    yield last, length


def _comment(text: str, start: int, before: Comment | None) -> Comment:
    line_start = text.rfind("\n", 0, start) + 1
    lead = text[line_start:start]
    column = len(lead.expandtabs())
    own_line = not lead.strip()
    follows = (
        own_line
        and before is not None
        and before.end == line_start - 1
        and before.column == column
        and (before.follows or not before.own_line)
    )
    comment = text[start : _end_of_line(text, start)].rstrip()
    return Comment(comment, start, column, len(lead.expandtabs().rstrip()), own_line, follows)


def _end_of_line(text: str, start: int) -> int:
    end = text.find("\n", start)
    return len(text) if end < 0 else end
