"""Values of which some may be faulty."""

from __future__ import annotations

from typing import TypeVar

from orchestra.resolve.context import Poison

_T = TypeVar("_T")


class Sound:
    """Takes values, gives None for faulty ones, and remembers whether there was one."""

    __slots__ = ("faulty",)

    def __init__(self) -> None:
        self.faulty = False

    def __call__(self, value: _T | Poison | None) -> _T | None:
        """Return the value, None for a faulty one."""
        if not isinstance(value, Poison):
            return value
        self.faulty = True
        return None
