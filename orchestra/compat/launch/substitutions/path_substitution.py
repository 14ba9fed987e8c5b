"""`PathSubstitution`: a path to which `/` adds (newer ROS releases)."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from orchestra.compat.described import described
from orchestra.compat.performed import Concatenated
from orchestra.compat.text import normalized

if TYPE_CHECKING:
    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub


class PathSubstitution(Concatenated):
    """A path of pathlib, a text, or substitutions."""

    def __init__(self, path: Sub | os.PathLike[str]) -> None:
        super().__init__(normalized(os.fspath(path) if isinstance(path, os.PathLike) else path))

    @property
    def path(self) -> list[Substitution]:
        """The path."""
        return list(self._subs)

    def describe(self) -> str:
        """Return the path and what it is."""
        return f"Path({described(self._subs)})"
