"""The sections of a file by the nodes that they are for: it may have one for each of a thousand nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.rcl.patterns import matches

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.resolve.rcl.sections import Section


class Indexed:
    """Sections in order, found by the full names of nodes without a look at all others.

    `_named` has those in whose patterns wildcards stand before the name of a node, `_open` those that end with one.
    """

    __slots__ = ("_exact", "_named", "_open", "sections")

    def __init__(self, sections: Sequence[Section]) -> None:
        self.sections = sections
        self._exact: dict[str, list[int]] = {}
        self._named: dict[str, list[int]] = {}
        self._open: list[int] = []
        for place, section in enumerate(sections):
            last = section.pattern.rpartition("/")[2]
            if "*" not in section.pattern:
                self._exact.setdefault(absolute(section.pattern), []).append(place)
            elif "*" not in last:
                self._named.setdefault(last, []).append(place)
            else:
                self._open.append(place)

    def matching(self, full_name: str) -> list[Section]:
        """Return the sections that are for a node, in order."""
        found = [*self._with_wildcards(full_name), *self._exact.get(full_name, ())]
        return [self.sections[place] for place in sorted(found)]

    def has_wildcard_for(self, full_name: str) -> bool:
        """Return whether a pattern with a wildcard is for a node."""
        return any(True for _ in self._with_wildcards(full_name))

    def _with_wildcards(self, full_name: str) -> Iterator[int]:
        for places in (self._open, self._named.get(full_name.rpartition("/")[2], ())):
            yield from (place for place in places if matches(self.sections[place].pattern, full_name))

    def everywhere(self) -> list[Section]:
        """Return the sections that are for every node, in order."""
        some = (self.sections[place] for place in self._open)
        return [section for section in some if section.pattern.lstrip("/") == "**"]


def absolute(pattern: str) -> str:
    """Return a pattern with its first slash, which may be left out."""
    return pattern if pattern.startswith("/") else f"/{pattern}"
