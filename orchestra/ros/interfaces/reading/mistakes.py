"""What is wrong in a definition, and where."""

from __future__ import annotations

from typing import NamedTuple


class Place(NamedTuple):
    """A part of a line: 1-based line and column in code points, the end exclusive."""

    line: int
    column: int
    end_column: int


class DefinitionError(ImportError):
    """A definition is none, or needs what is not here; so nothing of it can be imported.

    `file` is as the caller named it.
    """

    def __init__(self, message: str, file: str, place: Place | None = None) -> None:
        where = f"{file}:{place.line}:{place.column}" if place else file
        super().__init__(f"{where}: {message}")
        self.message = message
        self.file = file
        self.place = place
