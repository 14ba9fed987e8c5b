"""A comment as it stands in a file, whatever its language."""

from __future__ import annotations

import re
from typing import Final

from orchestra.dataclass import dataclass

# What speaks to programs that read the one language.
_PRAGMA: Final = re.compile(
    r"!|(-\*-\s*)?(coding|vim|ex|kate|noqa|nosec|type|mypy|pylint|pyright|ruff|isort|flake8|fmt|yamllint|"
    r"yaml-language-server)\b\s*[:=]|noqa\b|-\*-|(orchestra|fmt|yapf):"
)


@dataclass(frozen=True, slots=True)
class Comment:
    """The lines of a comment, and where it begins and ends: 1-based lines, and the column of its beginning.

    `behind` is what stands before it on its line, nothing where it has the line to itself.
    """

    lines: tuple[str, ...]
    line: int
    column: int
    end_line: int
    behind: str


@dataclass(frozen=True, slots=True)
class Scan:
    """The comments of a file in order, and the line at which its content begins."""

    comments: tuple[Comment, ...]
    content: int


def text_of(comment: str) -> str | None:
    """Return the text of a comment that begins with `#`; None for what only a program reads."""
    text = comment[1:].rstrip()
    bare = text.strip()
    if _PRAGMA.match(bare) or comment.startswith("#!"):
        return None
    return text.removeprefix(" ")
