"""The sections of a file by the nodes that they are for: it may have one for each of a thousand nodes."""

from __future__ import annotations

from itertools import chain
from typing import TYPE_CHECKING, Final

from orchestra.resolve.rcl.patterns import matches

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from orchestra.resolve.rcl.sections import Section

_EVERY: Final = frozenset({"**", "/**"})
_FEW: Final = 8  # patterns that are sooner tried one by one


class Indexed:
    """Sections in order, found by the full names of nodes without a look at all others.

    `_named` has those in whose patterns wildcards stand before the name of a node, `_open` those that end with one.
    Of many only those are looked at again whose parts are those of the name.
    """

    __slots__ = ("_exact", "_named", "_open", "_parted", "_wild", "for_all", "sections")

    def __init__(self, sections: Sequence[Section]) -> None:
        self.sections = sections
        self._exact: dict[str, list[int]] = {}
        self._named: dict[str, list[int]] = {}
        self._open: list[int] = []
        self._parted: Parted | None = None
        for place, section in enumerate(sections):
            last = section.pattern.rpartition("/")[2]
            if "*" not in section.pattern:
                self._exact.setdefault(absolute(section.pattern), []).append(place)
            elif "*" not in last:
                self._named.setdefault(last, []).append(place)
            else:
                self._open.append(place)
        self._wild = bool(self._open or self._named)
        # Whether each is for every node, as that of most files that are shared.
        self.for_all = all(section.pattern in _EVERY for section in sections)

    def matching(self, full_name: str) -> list[Section]:
        """Return the sections that are for a node, in order."""
        if self.for_all:
            return [*self.sections]
        exact = self._exact.get(full_name, ())
        if not self._wild:
            return [self.sections[place] for place in exact]
        found = self._with_wildcards(full_name)
        return [self.sections[place] for place in (sorted([*found, *exact]) if exact else sorted(found))]

    def has_wildcard_for(self, full_name: str) -> bool:
        """Return whether a pattern with a wildcard is for a node."""
        return self._wild and (self.for_all or bool(self._with_wildcards(full_name)))

    def _with_wildcards(self, full_name: str) -> list[int]:
        named = self._named.get(full_name.rpartition("/")[2], ()) if self._named else ()
        if len(named) + len(self._open) <= _FEW:
            places: Iterable[int] = (*self._open, *named) if named else self._open
        else:
            places = self._by_parts().found(full_name)
        sections = self.sections
        return [place for place in places if matches(sections[place].pattern, full_name)]

    def _by_parts(self) -> Parted:
        if self._parted is None:
            self._parted = Parted()
            for place in (*self._open, *chain.from_iterable(self._named.values())):
                self._parted.add(self.sections[place].pattern, place)
        return self._parted

    def everywhere(self) -> list[Section]:
        """Return the sections that are for every node, in order."""
        some = (self.sections[place] for place in self._open)
        return [section for section in some if section.pattern.lstrip("/") == "**"]


class Parted:
    """Patterns by their parts, each with a number: the ways from part to part, `**` standing for any number of them."""

    __slots__ = ("ends", "steps")

    def __init__(self) -> None:
        self.steps: dict[str, Parted] = {}
        self.ends: list[int] = []

    def add(self, pattern: str, number: int) -> None:
        """Take up a pattern."""
        at = self
        for part in absolute(pattern)[1:].split("/"):
            at = at.steps.setdefault(part, Parted())
        at.ends.append(number)

    def found(self, full_name: str) -> Iterator[int]:
        """Yield the numbers of the patterns to which a full name leads."""
        reached = self.reach({})
        for part in full_name[1:].split("/"):
            following = dict[int, tuple[Parted, bool]]()
            for at, stays in reached.values():
                if stays:
                    at.reach(following, stays=True)
                for step in {part, "*"}:
                    if step in at.steps:
                        at.steps[step].reach(following)
            reached = following
        return chain.from_iterable(at.ends for at, _ in reached.values())

    def reach(
        self, reached: dict[int, tuple[Parted, bool]], *, stays: bool = False
    ) -> dict[int, tuple[Parted, bool]]:
        """Note that this is reached, and what is behind it where `**` stands for nothing."""
        at: Parted | None = self
        while at is not None:
            reached[id(at)] = (at, stays)
            at, stays = at.steps.get("**"), True
        return reached


def absolute(pattern: str) -> str:
    """Return a pattern with its first slash, which may be left out."""
    return pattern if pattern.startswith("/") else f"/{pattern}"
