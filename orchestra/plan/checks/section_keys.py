"""The keys of sections of parameter files: the patterns in them, and what should stand in place of one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from orchestra.resolve.rcl.sections import Section

_ANY_NODE: Final = frozenset({"node", "ros", "ros2"})  # words that a name has or has not
_WILDCARDS: Final = frozenset({"*", "**"})


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
