"""Rows of words in columns, and the words for times and sizes in them."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    Paint = Callable[[int, int, str], str]

_MINUTE, _HOUR, _DAY = 60, 3600, 86400
_STEP = 1024


def aligned(
    rows: Sequence[Sequence[str]], paint: Paint = lambda _row, _column, text: text, indent: str = ""
) -> str:
    """Return rows as text, each column as wide as its widest word; `paint` is given row, column and padded word."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = []
    for number, row in enumerate(rows):
        last = max((column for column, word in enumerate(row) if word), default=0)
        cells = [
            paint(number, column, word if column == last else word.ljust(widths[column]))
            for column, word in enumerate(row[: last + 1])
        ]
        lines.append(f"{indent}{'  '.join(cells)}\n")
    return "".join(lines)


def duration(seconds: float | None) -> str:
    """Return a time in the two largest units that it has, `-` for none."""
    if seconds is None:
        return "-"
    whole = int(seconds)
    if whole < _MINUTE:
        return f"{seconds:.1f}s" if seconds < 10 else f"{whole}s"  # noqa: PLR2004 - tenths of few seconds
    if whole < _HOUR:
        return f"{whole // _MINUTE}m{whole % _MINUTE:02}s"
    if whole < _DAY:
        return f"{whole // _HOUR}h{whole % _HOUR // _MINUTE:02}m"
    return f"{whole // _DAY}d{whole % _DAY // _HOUR:02}h"


def size(count: int | None) -> str:
    """Return a number of bytes in the largest unit of which it is at least one, `-` for none."""
    if count is None:
        return "-"
    amount = float(count)
    for unit in ("B", "K", "M", "G"):
        if amount < _STEP:
            return f"{amount:.0f}{unit}" if unit in "BK" or amount >= 100 else f"{amount:.1f}{unit}"  # noqa: PLR2004
        amount /= _STEP
    return f"{amount:.1f}T"
