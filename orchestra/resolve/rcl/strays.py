"""What stands where rcl takes nothing: outside the parameters of a node, or a key with nothing behind it.

rcl stops at the first such value. Here one mistake is told once, at its key: of several parameters without
`ros__parameters` the first, and of a line that is indented too little that line, not the key above it.
"""

from __future__ import annotations

import re
from dataclasses import field
from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.errors import Code, Problems
from orchestra.location import Location
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from collections.abc import Sequence

SECTION_KEY: Final = "ros__parameters"

_UNPREFIXED: Final = ("parameter", "parameters", "params")
_MISSPELT: Final = re.compile(r"ros[_-]*p[a-z]{1,4}m[a-z]{0,6}", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Key:
    """A key of a mapping: its place, and how many mappings are around it."""

    name: str
    at: Location
    depth: int


def is_section(name: str) -> bool:
    """Return whether rcl takes a key for `ros__parameters`: it looks only at how it begins."""
    return name.startswith(SECTION_KEY)


def is_misspelt_section(name: str) -> bool:
    """Return whether a key is plainly meant to be `ros__parameters`."""
    if is_section(name) or _MISSPELT.fullmatch(name) is None:
        return False
    return nearest(name, (SECTION_KEY,)) is not None


@dataclass(slots=True)
class Strays:
    """Reports strays; `told` are the keys of the file's mapping below which one has been."""

    problems: Problems
    told: set[str] = field(default_factory=set)
    empty: Key | None = None

    def has_told(self, keys: Sequence[str]) -> bool:
        """Return whether a stray has been told of the node that these keys are of."""
        return _outermost(keys) in self.told

    def value(
        self,
        key: Key,
        keys: Sequence[str],
        above: Location | None,
        ended: Location | None,
        *,
        empty: bool,
    ) -> None:
        """Take a value above the parameters.

        `keys` are those of the mappings around its key, the innermost of them is `above`; `ended` is the place of an
        empty mapping that has ended the parameters for rcl.
        """
        if empty:
            self.empty = key
        elif not self.has_told(keys):
            self.told.add(_outermost(keys))
            if keys[-1] in _UNPREFIXED and len(keys) > 2 and above is not None:  # noqa: PLR2004 - a node around it
                message = f"'{keys[-1]}' is not '{SECTION_KEY}', below which parameters belong"
                self.problems.error(Code.PARAMETER_SYNTAX, message, above, suggestion=SECTION_KEY)
                return
            notes = () if ended is None else (f"the empty mapping at {ended} ends the section for rcl",)
            message = f"'{key.name}' stands outside '{SECTION_KEY}': parameters belong below '{SECTION_KEY}' of a node"
            self.problems.error(Code.PARAMETER_SYNTAX, message, key.at, notes=notes)

    def key(self, key: Key, keys: Sequence[str]) -> bool:
        """Take a key that is no parameter's; return whether it has been told to stand beside what it belongs below."""
        above, self.empty = self.empty, None
        if above is None:
            return False
        if above.depth == key.depth and is_section(above.name) != is_section(key.name):
            message = f"'{key.name}' stands beside '{above.name}': it is to be indented more"
            self.problems.error(Code.PARAMETER_SYNTAX, message, key.at)
            self.told.add(_outermost(keys))
            return True
        self._tell(above)
        return False

    def end(self) -> None:
        """Take the end of a mapping, or of the file: an empty key is nothing but empty."""
        if self.empty is not None:
            self._tell(self.empty)
            self.empty = None

    def _tell(self, key: Key) -> None:
        if is_section(key.name):
            message = f"'{key.name}' is empty: it must hold a mapping from names to values"
        else:
            message = f"'{key.name}' is empty: parameters belong below '{SECTION_KEY}' of a node"
        self.problems.error(Code.PARAMETER_SYNTAX, message, key.at)


def _outermost(keys: Sequence[str]) -> str:
    """Return the key of the file's own mapping that is around, nothing where there is none."""
    return keys[1] if len(keys) > 1 else ""
