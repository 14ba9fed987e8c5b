"""The keys of sections of parameter files: the patterns in them, and what should stand in place of one."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.fields import replace
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from orchestra.location import Location
    from orchestra.resolve.rcl.sections import Section

_ANY_NODE: Final = frozenset({"node", "ros", "ros2"})  # words that a name has or has not
_WILDCARDS: Final = frozenset({"*", "**"})
_KEY: Final = pattern(r"( *)([\w/]+):\s*(?:#.*)?$")


def key_for(section: Section, name: str) -> str | None:
    """Return what should stand in place of the key of a section for a node, None where one key cannot say it."""
    namespace, _, own = name.rpartition("/")
    there, _, last = absolute(section.pattern).rpartition("/")
    if is_for_any(section.pattern):
        return "/**"
    if not is_one_key(section):
        return own if there == namespace else None
    if last == own:
        return f"/**/{own}"
    if last in _WILDCARDS:
        below = f"{namespace}/".startswith(f"{there}/") and there
        return f"{there}/**" if below else f"{namespace}/{last}" if namespace else "/**"
    lead = section.pattern[: len(section.pattern) - len(last)]
    return f"{lead}{own}" if there in (namespace, "/**") else name


def outer_key(section: Section, name: str, path: str) -> tuple[Location, str] | None:
    """Return the place of the one namespace by which the keys of a section miss a node, and what should stand there.

    None where the keys do not stand on lines of their own, one for each namespace, or miss it otherwise.
    """
    theirs, ours = absolute(section.pattern).split("/")[1:], name.split("/")[1:]
    differing = [place for place, pair in enumerate(zip(theirs, ours, strict=False)) if pair[0] != pair[1]]
    if len(theirs) != len(ours) or len(differing) != 1 or differing[0] == len(ours) - 1:
        return None
    at, found = section.location.span, list[tuple[int, re.Match[str]]]()
    column, lines = at.column - 1, Path(path).read_text("utf-8", "replace").split("\n")
    for number in range(at.line - 1, 0, -1):
        key = _KEY.match(lines[number - 1])
        if key is not None and len(key[1]) < column:
            found.insert(0, (number, key))
            column = len(key[1])
    if len(found) != len(ours) - 1 or column:
        return None
    (number, key), meant = found[differing[0]], ours[differing[0]]
    if key[2].removeprefix("/") != theirs[differing[0]]:
        return None
    begin, end = (place + 1 for place in key.span(2))
    span = replace(at, line=number, column=begin, end_line=number, end_column=end)
    return replace(section.location, span=span), f"/{meant}" if key[2].startswith("/") else meant


def words_of(name: str) -> list[str]:
    """Return the words of a name in the order of the alphabet, without those that any name may have."""
    words = sorted(name.lower().split("_"))
    return [word for word in words if word not in _ANY_NODE] or words


def is_for_any(pattern: str) -> bool:
    """Return whether nothing but wildcards stand in a pattern."""
    return _WILDCARDS.issuperset(absolute(pattern)[1:].split("/"))


def is_one_key(section: Section) -> bool:
    """Return whether all of a pattern stands in one key, with or without quotes."""
    span = section.location.span
    width = span.end_column - span.column
    return span.line == span.end_line and width - len(section.pattern) in (0, 2)


def absolute(pattern: str) -> str:
    """Return a pattern with its first slash."""
    return pattern if pattern.startswith("/") else f"/{pattern}"
