"""Lines of a file that is being laid out, and the comments at their ends, which stay in their columns."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

_LEAST_GAP = 2


@dataclass(frozen=True, slots=True)
class Tail:
    """A comment at the end of a line: its column as it was, and that at which what stood before it ended."""

    text: str
    column: int
    behind: int


@dataclass(slots=True)
class Line:
    """A line: what stands there, indentation included, and the comment behind it."""

    text: str
    tail: Tail | None = None


def joined(lines: Sequence[Line]) -> str:
    """Return the text of the lines, each comment behind its line.

    Comments that stood in one column, with no empty line and no line that is a comment alone between them, stand in
    one column again: as far behind the longest line as they were.
    """
    texts = [line.text for line in lines]
    for group in _groups(lines):
        tails = [(index, tail) for index in group if (tail := lines[index].tail) is not None]
        gap = max(min(tail.column - tail.behind for _, tail in tails), _LEAST_GAP)
        column = max(len(texts[index]) for index, _ in tails) + gap
        for index, tail in tails:
            texts[index] = f"{texts[index]:<{column}}{tail.text}"
    return "".join(f"{text}\n" for text in texts)


def _groups(lines: Sequence[Line]) -> Iterator[list[int]]:
    """Yield the lines whose comments stand in one column together."""
    group: list[int] = []
    for index, line in enumerate(lines):
        if line.tail is None:
            if group and _parts(line.text):
                yield group
                group = []
            continue
        first = lines[group[0]].tail if group else None
        if first is not None and first.column != line.tail.column:
            yield group
            group = []
        group.append(index)
    if group:
        yield group


def _parts(text: str) -> bool:
    """Tell whether a line without a comment behind it ends a group: an empty one, or one that is a comment."""
    return not text.strip() or text.lstrip().startswith(("#", "<!--"))


def shifted(lines: Iterable[str], by: int, least: int = 0) -> Iterator[str]:
    """Yield lines with their indentation changed, empty ones empty, none indented less than asked for."""
    for line in lines:
        content = line.lstrip()
        yield " " * max(indentation(line) + by, least) + content if content else ""


def indentation(line: str) -> int:
    """Return the column at which a line begins, tabs counted to the next multiple of eight."""
    return len(line[: len(line) - len(line.lstrip())].expandtabs())
