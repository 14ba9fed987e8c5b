"""The page that a YAML file is laid out on: its lines, and the comments of the file in their places."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.formatting.lines import Line, Tail, joined
from orchestra.formatting.yaml_nodes import File

if TYPE_CHECKING:
    from orchestra.formatting.yaml_comments import Comment

# What may stand between a key or a dash and a comment on its line: the colon, tags and anchors.
_BETWEEN = re.compile(r"[ \t]*:?(?:[ \t]+[&!]\S*)*[ \t]*")


@dataclass(frozen=True, slots=True)
class Level:
    """A list or mapping whose entries are being laid out: the column of these before and after."""

    before: int
    after: int


@dataclass(slots=True)
class Page:
    """Lines so far. `lead` is what stands on the next line already, the dashes of lists; `fresh`: a level begins."""

    file: File
    lines: list[Line] = field(default_factory=list)
    lead: str | None = None
    levels: list[Level] = field(default_factory=lambda: [Level(0, 0)])
    fresh: bool = True
    told: int = 0

    def finished(self) -> str:
        """Add the comments that are left and return the text."""
        self.comments(len(self.file.text), 1)
        return joined(self.lines)

    def margin(self, indent: int) -> str:
        """Return what stands before the text of the next line."""
        return " " * indent if self.lead is None else self.lead

    def put(self, text: str, indent: int) -> None:
        """Add a line, behind what stands on it already."""
        line = self.margin(indent) + text
        self.lines.append(Line(line if text else line.rstrip()))
        self.lead = None
        self.fresh = False

    def put_lines(self, first: str, rest: list[str], indent: int) -> None:
        """Add several lines, of which the first is not indented yet."""
        self.put(first, indent)
        self.lines.extend(map(Line, rest))

    def pending(self) -> Comment | None:
        """Return the comment that comes next."""
        comments = self.file.comments
        return comments[self.told] if self.told < len(comments) else None

    def interrupted(self, offset: int) -> bool:
        """Tell whether a comment comes before an offset."""
        comment = self.pending()
        return comment is not None and comment.start < offset

    def skip(self, end: int) -> None:
        """Leave out the comments of what has been taken over as it stands."""
        while self.interrupted(end):
            self.told += 1

    def tail(self, offset: int, line: int = -1) -> None:
        """Put the comment that stands right behind an offset behind a line, the last one where none is named."""
        comment = self.pending()
        if comment is None or not _BETWEEN.fullmatch(self.file.text, offset, max(offset, comment.start)):
            return
        self.told += 1
        self.lines[line].tail = Tail(comment.text, comment.column, comment.behind)

    def begin(self, offset: int, indent: int) -> None:
        """Begin a level whose first entry stands at an offset."""
        self.levels.append(Level(self.file.column(offset), indent))
        self.fresh = True

    def hollow(self, offset: int, indent: int) -> None:
        """Begin a level that has no entries but may have comments, below an entry that stands at an offset."""
        self.levels.append(Level(self.file.column(offset) + 1, indent))

    def entry(self, offset: int, depth: int) -> None:
        """Begin an entry of the level at a depth: the comments before it, an empty line where one stood."""
        self.comments(offset, depth)
        del self.levels[depth:]
        self.blank(offset)

    def comments(self, offset: int, depth: int) -> None:
        """Add comments on lines of their own, each at the innermost level left that it is indented for."""
        deepest = len(self.levels)
        while (comment := self.pending()) is not None and comment.start < offset:
            self.told += 1
            if comment.follows and self.lines:
                self.lines.append(Line("", Tail(comment.text, comment.column, comment.behind)))
                continue
            while deepest > depth and self.levels[deepest - 1].before > comment.column:
                deepest -= 1
            self.blank(comment.start)
            self.lines.append(Line(" " * self.levels[deepest - 1].after + comment.text))
            self.fresh = False

    def blank(self, offset: int) -> None:
        """Add an empty line where one or more stand before an offset, unless a level begins there."""
        if self.fresh or self.lead is not None:
            return
        last = self.lines[-1]
        if self.file.breaks_before(offset) > 1 and (last.text.strip() or last.tail):
            self.lines.append(Line(""))
