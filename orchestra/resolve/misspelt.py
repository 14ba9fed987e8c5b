"""Where the wrong part of a value that was put together stands, and how it was to be written there.

`$(dirname)/$(var file)` may be wrong in what is written, or in what `file` was set to. The names that are wrong and
those that were meant are known; the text that holds their difference is looked for at the value, then at what was read
to make it.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.location import Location

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.resolve.context import Read, Value

_CALL: Final = "\0"  # stands for each character of a substitution
_EDGES: Final = ("", "/", _CALL)


@dataclass(frozen=True, slots=True)
class Misspelt:
    """The place of a text, and what should stand there."""

    at: Location
    instead: str


def misspelt(value: Value, written: str, changes: Sequence[tuple[str, str]]) -> Misspelt | None:
    """Return the one text in which all names of a value are wrong; `changes` has them with those that were meant.

    `written` is the text of the value itself. None where no single text has them all.
    """
    if not changes:
        return None
    for location, text in _texts(value, written):
        instead = text
        for name, near in changes:
            instead = _rewritten(instead, name, near)
        if all(_rewritten(text, name, near) != text for name, near in changes):
            return Misspelt(location, instead)
    return None


def _texts(value: Value, written: str) -> Iterator[tuple[Location, str]]:
    yield value.location, written
    yield from _sources(value.through)


def _sources(through: Sequence[Read]) -> Iterator[tuple[Location, str]]:
    """Yield the texts that what was read was made of, the last one read first."""
    for read in reversed(through):
        source = read.source
        if source is not None and (source.verbatim or source.raw is not None):
            yield source.location, source.raw if source.raw is not None else source.text
        yield from _sources(read.through)


def _rewritten(text: str, name: str, near: str) -> str:
    """Return a text with the part of a name that is wrong in it put right; the same text where it has none of that.

    The part is the whole name, or what is left of it beside substitutions that have given the rest.
    """
    plain = _without_calls(text)
    for begin, end in _parts(name, near):
        part, instead = name[begin:end], near[begin : len(near) - (len(name) - end)]
        at = plain.rfind(part)
        while at >= 0:
            before, behind = plain[:at][-1:], plain[at + len(part) :][:1]
            whole = (begin == 0 or before != "/") and (end == len(name) or behind != "/")
            if before in _EDGES and behind in _EDGES and whole:
                return f"{text[:at]}{instead}{text[at + len(part) :]}"
            at = plain.rfind(part, 0, at)
    return text


def _parts(name: str, near: str) -> Iterator[tuple[int, int]]:
    """Yield the parts of a name that hold all in which it differs from another, the longest first."""
    shorter = min(len(name), len(near))
    same = next((at for at in range(shorter) if name[at] != near[at]), shorter)
    tail = next((at for at in range(shorter - same) if name[-1 - at] != near[-1 - at]), shorter - same)
    parts = [(begin, len(name) - left) for begin in range(same + 1) for left in range(tail + 1)]
    yield from sorted((part for part in parts if part[0] < part[1]), key=lambda part: part[0] - part[1])


def _without_calls(text: str) -> str:
    """Return a text with its substitutions blotted out."""
    plain, at = list(text), 0
    for found in re.finditer(r"\$\(", text):
        if found.start() < at:
            continue
        depth, at = 1, found.end()
        while at < len(text) and depth:
            depth += {"(": 1, ")": -1}.get(text[at], 0)
            at += 1
        plain[found.start() : at] = _CALL * (at - found.start())
    return "".join(plain)
