"""A text with what was meant in place of what keeps it from being read, whose places are those of the file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.load.offsets import Source

if TYPE_CHECKING:
    from collections.abc import Sequence


@dataclass(frozen=True, slots=True)
class Mend:
    """What to put in place of ranges of a text: each two offsets and a text, in rising order.

    `doubted` is the range that may be meant otherwise, None for what was suggested, which is no guess.
    """

    edits: tuple[tuple[int, int, str], ...]
    doubted: tuple[int, int] | None = None


@dataclass(frozen=True)
class Mended(Source):
    """A text that was made of another one by an edit."""

    before: Source
    begin: int
    end: int
    width: int  # of what stands there now

    def place(self, offset: int) -> tuple[int, int]:
        """Return the 1-based line and column of an offset in the file as it is."""
        return self.before.place(self.written(offset))

    def written(self, offset: int) -> int:
        """Return the offset in the text before."""
        if offset < self.begin or (offset == self.begin and self.end > self.begin):
            return offset
        if offset < self.begin + self.width:
            return min(offset, self.end)
        return offset - self.width + self.end - self.begin


def mended(whole: Source, edits: Sequence[tuple[int, int, str]]) -> Source:
    """Return a text with edits."""
    for begin, end, meant in reversed(edits):
        text = whole.text[:begin] + meant + whole.text[end:]
        whole = Mended(whole.file, text, whole, begin, end, len(meant))
    return whole
