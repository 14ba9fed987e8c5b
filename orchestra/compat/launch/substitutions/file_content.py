"""`FileContent`: the text of a file."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from orchestra.compat.described import described
from orchestra.compat.parsed import ParsedSubstitution
from orchestra.compat.text import normalized

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub


class FileContent(ParsedSubstitution):
    """The text of a file, its last line break kept; paths of pathlib are welcome too."""

    _name = "file-content"
    _parameters = ("path",)

    def __init__(self, path: Sub | os.PathLike[str]) -> None:
        super().__init__()
        self.__path = normalized(os.fspath(path) if isinstance(path, os.PathLike) else path)

    @property
    def path(self) -> list[Substitution]:
        """The path."""
        return self.__path

    def describe(self) -> str:
        """Return the path and what it is."""
        return f"FileContent({described(self.path)})"

    def _arguments(self) -> Sequence[Sequence[Substitution]]:
        return (self.path,)
