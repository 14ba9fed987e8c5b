"""A text with what was meant in place of what keeps it from being read, whose places are those of the file."""

from __future__ import annotations

from bisect import bisect_left
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
    """A text that was made of another one by edits; `begins` are the offsets in it where those begin."""

    before: Source
    edits: tuple[tuple[int, int, str], ...]
    begins: tuple[int, ...]

    def place(self, offset: int) -> tuple[int, int]:
        """Return the 1-based line and column of an offset in the file as it is."""
        return self.before.place(self.written(offset))

    def written(self, offset: int) -> int:
        """Return the offset in the text before."""
        number = bisect_left(self.begins, offset)
        if number == len(self.begins) or self.begins[number] > offset:
            number -= 1
        if number < 0:
            return offset
        begin, end, meant = self.edits[number]
        within = offset - self.begins[number]
        if within == 0 and end > begin:
            return begin
        return min(begin + within, end) if within < len(meant) else end + within - len(meant)


def mended(whole: Source, edits: Sequence[tuple[int, int, str]]) -> Source:
    """Return a text with edits."""
    parts, begins, at, length = list[str](), list[int](), 0, 0
    for begin, end, meant in edits:
        begins.append(length + begin - at)
        parts += [whole.text[at:begin], meant]
        at, length = end, begins[-1] + len(meant)
    text = "".join([*parts, whole.text[at:]])
    return Mended(whole.file, text, whole, tuple(edits), tuple(begins))
