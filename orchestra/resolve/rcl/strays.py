"""What stands where rcl takes nothing: outside the parameters of a node, or a key with nothing behind it.

rcl stops at the first such value. Here one mistake is told once, when all of its node is known: where `ros__parameters`
is missing, at the key that lacks it, and of a line that is indented too little that line, not the key above it.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.errors import Code, Problems
from orchestra.fields import field
from orchestra.location import Location, Span
from orchestra.nearest import nearest
from orchestra.patterns import pattern
from orchestra.pyyaml import yaml

if TYPE_CHECKING:
    from collections.abc import Sequence

SECTION_KEY: Final = "ros__parameters"

_NODE_DEPTH: Final = 2  # inside the file's mapping, inside that of a key of it
_UNPREFIXED: Final = ("parameter", "parameters", "params")
_COLON: Final = pattern(r"([^\s:\[\]{}]+):\s*(\S+)")
_PAIR: Final = pattern(r"[\w.]+: +[^\s:#\"']+")
_EQUALS: Final = pattern(r"([\w.]+)\s*:?=\s*(\S+)")
_MISSPELT: Final = pattern(
    r"_*(?:ro?s|rso|ors|os|ro|ross|roos|rros)[_. -]*p?[a-z]{1,4}m[a-z]{0,6}", re.IGNORECASE
)


@dataclass(frozen=True, slots=True)
class Key:
    """A key of a mapping: its place, and how many mappings are around it."""

    name: str
    at: Location
    depth: int


@dataclass(frozen=True, slots=True)
class _Stray:
    """A value above the parameters: its key, the keys of the mappings around it, and the place of the innermost.

    `ended` is the place of an empty mapping that has ended the parameters for rcl.
    """

    key: Key
    keys: tuple[str, ...]
    above: Location | None
    ended: Location | None


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
    """Reports strays, one for each key of the file's mapping; `held` are those of which not all is known yet.

    `sections` are the keys of the mappings that have `ros__parameters`, `around` the depths of those that are open:
    rcl takes the same keys again, in a mapping of their own.
    """

    problems: Problems
    told: set[str] = field(default_factory=set)
    held: dict[str, _Stray] = field(default_factory=dict)
    sections: set[tuple[str, ...]] = field(default_factory=set)
    around: set[int] = field(default_factory=set)
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
            return
        outermost = _outermost(keys)
        held = self.held.get(outermost)
        if (held is None and outermost not in self.told) or (held is not None and len(keys) < len(held.keys)):
            self.held[outermost] = _Stray(key, tuple(keys), above, ended)
        self.told.add(outermost)

    def key(self, key: Key, keys: Sequence[str]) -> bool:
        """Take a key that is no parameter's; return whether it has been told to stand beside what it belongs below."""
        above, self.empty = self.empty, None
        if is_section(key.name):
            self.sections.add(tuple(keys))
            self.around.add(key.depth)
        if above is None:
            return False
        if above.depth == key.depth and is_section(above.name) != is_section(key.name):
            message = f"'{key.name}' stands beside '{above.name}': it is to be indented more"
            self.problems.error(Code.PARAMETER_SYNTAX, message, key.at)
            self.told.add(_outermost(keys))
            return True
        self._tell(above)
        return False

    def no_mapping(self, event: yaml.Event, at: Location) -> None:
        """Report what stands below `ros__parameters` and is no mapping: a colon may lack the blank behind it."""
        found = equals = None
        if isinstance(event, yaml.ScalarEvent) and not event.style:
            found, equals = _COLON.match(event.value), _EQUALS.fullmatch(event.value)
        elif isinstance(event, yaml.ScalarEvent) and _PAIR.fullmatch(event.value):
            message = f"quotes around '{event.value}' make one text of a name and its value"
            self.problems.error(Code.PARAMETER_SYNTAX, message, at, suggestion=event.value)
            return
        if equals is not None and found is None:
            message = f"a colon and a blank stand between '{equals[1]}' and its value, not '='"
            instead = f"{equals[1]}: {equals[2]}"
            self.problems.error(Code.PARAMETER_SYNTAX, message, at, suggestion=instead)
            return
        if found is None:
            message = f"'{SECTION_KEY}' must hold a mapping from names to values"
            self.problems.error(Code.PARAMETER_SYNTAX, message, at)
            return
        span = at.span
        word = Span(span.file, span.line, span.column, span.line, span.column + len(found[0]))
        message = f"a blank is missing behind '{found[1]}:'"
        instead = f"{found[1]}: {found[2]}"
        self.problems.error(
            Code.PARAMETER_SYNTAX, message, Location(word, at.included_from), suggestion=instead
        )

    def end(self, depth: int) -> None:
        """Take the end of a mapping so deep, or of the file: an empty key is nothing but empty, a node is known."""
        self.around.discard(depth)
        if self.empty is not None:
            self._tell(self.empty)
            self.empty = None
        if depth > _NODE_DEPTH or (depth and not self.sections):
            return
        if (
            not self.sections and "" in self.held
        ):  # nothing but parameters, as files of ROS 1 have: that is one mistake
            self.held = {"": self.held[""]}
        for stray in self.held.values():
            self._tell_stray(stray)
        self.held.clear()

    def _tell_stray(self, stray: _Stray) -> None:
        key, keys, above = stray.key, stray.keys, stray.above
        within = above is not None and len(keys) > 1
        if above is not None and keys[-1] in _UNPREFIXED and len(keys) > 2:  # noqa: PLR2004 - a node around it
            message = f"'{keys[-1]}' is not '{SECTION_KEY}', below which parameters belong"
            self.problems.error(Code.PARAMETER_SYNTAX, message, above, suggestion=SECTION_KEY)
        elif within and keys not in self.sections and not any(map(is_section, keys)) and stray.ended is None:
            message = f"'{SECTION_KEY}' is missing below '{keys[-1]}': parameters belong below it"
            one = f"'{key.name}' at {key.at} is one"
            self.problems.error(Code.PARAMETER_SYNTAX, message, above, notes=(one,))
        else:
            notes = (
                ()
                if stray.ended is None
                else (f"the empty mapping at {stray.ended} ends the section for rcl",)
            )
            message = f"'{key.name}' stands outside '{SECTION_KEY}': parameters belong below '{SECTION_KEY}' of a node"
            self.problems.error(Code.PARAMETER_SYNTAX, message, key.at, notes=notes)

    def _tell(self, key: Key) -> None:
        if is_section(key.name):
            message = f"'{key.name}' is empty: it must hold a mapping from names to values"
        else:
            message = f"'{key.name}' is empty: parameters belong below '{SECTION_KEY}' of a node"
        self.problems.error(Code.PARAMETER_SYNTAX, message, key.at)


def _outermost(keys: Sequence[str]) -> str:
    """Return the key of the file's own mapping that is around, nothing where there is none."""
    return keys[1] if len(keys) > 1 else ""
