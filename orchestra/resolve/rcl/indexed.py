"""The sections of a file by the nodes that they are for: it may have one for each of a thousand nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.rcl.patterns import matches

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.resolve.rcl.sections import Section


class Indexed:
    """Sections in order, found by the full names of nodes without a look at all others."""

    __slots__ = ("_exact", "_open", "sections")

    def __init__(self, sections: Sequence[Section]) -> None:
        self.sections = sections
        self._exact: dict[str, list[int]] = {}
        self._open: list[int] = []
        for place, section in enumerate(sections):
            if "*" in section.pattern:
                self._open.append(place)
            else:
                self._exact.setdefault(absolute(section.pattern), []).append(place)

    def matching(self, full_name: str) -> list[Section]:
        """Return the sections that are for a node, in order."""
        found = [place for place in self._open if matches(self.sections[place].pattern, full_name)]
        found += self._exact.get(full_name, ())
        return [self.sections[place] for place in sorted(found)]

    def everywhere(self) -> list[Section]:
        """Return the sections that are for every node, in order."""
        some = (self.sections[place] for place in self._open)
        return [section for section in some if section.pattern.lstrip("/") == "**"]


def absolute(pattern: str) -> str:
    """Return a pattern with its first slash, which may be left out."""
    return pattern if pattern.startswith("/") else f"/{pattern}"
