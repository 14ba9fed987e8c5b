"""`YamlValue`: what stands under a key of a YAML file. Upstream has no such class."""

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


class YamlValue(ParsedSubstitution):
    """A scalar, the items of a list or the keys of a mapping with commas between them; else the default."""

    _name = "yaml-value"
    _parameters = ("path", "key", "default")

    def __init__(self, path: Sub | os.PathLike[str], key: Sub, *, default: Sub | None = None) -> None:
        super().__init__()
        self.__path = normalized(os.fspath(path) if isinstance(path, os.PathLike) else path)
        self.__key = normalized(key)
        self.__default = None if default is None else normalized(default)

    @property
    def path(self) -> list[Substitution]:
        """The path."""
        return self.__path

    @property
    def key(self) -> list[Substitution]:
        """The key: with dots, one in a mapping in a mapping."""
        return self.__key

    def describe(self) -> str:
        """Return the path and the key, and what they are."""
        return f"YamlValue({described(self.path)}, {described(self.key)})"

    def _arguments(self) -> Sequence[Sequence[Substitution]]:
        given = (self.path, self.key)
        return given if self.__default is None else (*given, self.__default)
