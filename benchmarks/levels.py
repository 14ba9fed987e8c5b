"""Launch files that include others, level by level, until one at the top includes all."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

# A file beside the others, and the robot that its nodes are of.
File: TypeAlias = tuple[str, str]


def top(level: Sequence[File], including: Callable[[str, Sequence[File]], File], files: int = 10) -> str:
    """Return the name of the file at the top, where each includes so many; `including` writes one of a name."""
    height = 0
    while height == 0 or len(level) > 1:
        height += 1
        level = [
            including(f"part{height}_{begin}", level[begin : begin + files])
            for begin in range(0, len(level), files)
        ]
    return level[0][0]
