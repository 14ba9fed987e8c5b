"""Where a value was written: spans in files, and the includes on the way to them."""

from __future__ import annotations

import os
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, order=True)
class Span:
    """A range of text. Lines and columns are 1-based, columns count code points, the end is exclusive."""

    file: str
    line: int
    column: int
    end_line: int
    end_column: int

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}"


@dataclass(frozen=True, slots=True)
class Location:
    """A span, and the include actions that led to its file, innermost first."""

    span: Span
    included_from: tuple[Span, ...] = ()

    def __str__(self) -> str:
        return str(self.span)


def point(file: str, line: int = 1, column: int = 1) -> Span:
    """Return the empty span at one place."""
    return Span(file, line, column, line, column)


def is_python(place: Span | Location) -> bool:
    """Return whether a place is in a Python file: strictness that files of others cannot stand ends there.

    Most launch files that exist are in Python; what upstream lets pass in them is told, not refused.
    """
    span = place.span if isinstance(place, Location) else place
    return span.file.endswith(".py")


def displayed(path: str) -> str:
    """Return the path as it is shown to people: relative where it is below the working directory."""
    try:
        absolute = os.path.realpath(path)
    except ValueError:  # no file can have such a name, as one with NUL
        return path
    prefix = os.path.join(os.path.realpath(os.getcwd()), "")  # noqa: PTH118, PTH109 - pathlib is slow to import
    return absolute.removeprefix(prefix)


def is_file(path: str | os.PathLike[str]) -> bool:
    """Return whether a file can be seen there; a path that the system refuses (too long, no permission) is none."""
    return os.path.isfile(path)  # noqa: PTH113 - pathlib raises for such paths
