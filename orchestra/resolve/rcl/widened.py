"""Values for a node that the same file sets once more, behind them, by a wildcard or by the name in its other form.

A node applies the patterns that match it in their order, so a wildcard behind the section of a node overrules it; who
writes defaults for all nodes writes them first.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.resolve.rcl.patterns import matches

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.resolve.rcl.sections import Entry, Section

_MOST: Final = 10_000  # pairs of a wildcard and a name that are compared


def widened(sections: Sequence[Section]) -> Iterator[tuple[Entry, Entry, str]]:
    """Yield values with those that they overrule, and the name of the node that these are for: of each one pair."""
    named: dict[str, list[Section]] = {}
    left = _MOST
    for section in sections:
        bare = section.pattern.removeprefix("/")
        if "*" in bare:
            left -= len(named)
            names = [name for name in named if matches(section.pattern, f"/{name}")] if left > 0 else []
        else:
            names = [bare] if bare in named else []
        overruled = {
            entry.name: (entry, name)
            for name in names
            for other in named[name]
            if other.pattern != section.pattern
            for entry in other.entries
            if entry.value is not None
        }
        for entry in section.entries if overruled else ():
            earlier, name = overruled.pop(entry.name, (None, ""))
            if earlier is not None and entry.value is not None and repr(entry.value) != repr(earlier.value):
                yield entry, earlier, name
        if "*" not in bare:
            named.setdefault(bare, []).append(section)
