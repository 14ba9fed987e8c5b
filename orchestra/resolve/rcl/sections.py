"""The parts of a parameter file as rcl sees them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.dataclass import dataclass, maker
from orchestra.location import Location, Span, new_location
from orchestra.values import ParameterValue


@dataclass(frozen=True, slots=True)
class Entry:
    """One parameter that a section sets.

    `name` is the whole dotted name, `location` that of the value, `key` that of the name. `value` is None where rcl
    has the parameter without a value (an empty list or mapping). `slot` is the name under which rcl looks for the
    place to put it: for what is nested, the name of the mapping around it. `opens` marks a key that stands for no
    parameter but for a group of them. `items` are the places of the items of a list.
    """

    name: str
    value: ParameterValue | None
    location: Location
    key: Location
    slot: str
    opens: bool = False
    items: tuple[Location, ...] = ()


new_entry = maker(Entry)


class _Included:
    """A section that was read for nobody, and the includes that have led to this one."""

    __slots__ = ("_of",)

    _of: tuple[Section, tuple[Span, ...]] | None


@dataclass(frozen=True, slots=True)
class Section(_Included):
    """What one `ros__parameters` mapping sets for the nodes that match a pattern.

    The pattern is as rcl keeps it, nested keys joined with `/`: `ns/n` and `/ns/n` match the same nodes but count as
    two patterns where the order matters. `location` is that of the last key of the pattern: the node's name. Places
    of an `included` one are worked out when somebody asks.
    """

    pattern: str
    entries: tuple[Entry, ...]
    location: Location

    @property
    def shared(self) -> Section:
        """The section that was read for nobody: whatever is no place is the same in it."""
        return self if self._of is None else self._of[0]

    if not TYPE_CHECKING:  # for type checkers there are the fields above and no others

        def __getattr__(self, name: str) -> object:
            if name == "_of":
                return None
            if name not in ("entries", "location") or self._of is None:
                raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
            section, chain = self._of
            found = _at(section.location, chain) if name == "location" else _entries(section, chain)
            object.__setattr__(self, name, found)
            return found


maker(Section)  # it refuses nothing, for `included`


def included(section: Section, chain: tuple[Span, ...]) -> Section:
    """Return a section of a file that was read for nobody as that of one which includes led to."""
    made: Any = object.__new__(Section)
    made.pattern = section.pattern
    made._of = section, chain  # noqa: SLF001 - it is made here
    found: Section = made
    return found


def _entries(section: Section, chain: tuple[Span, ...]) -> tuple[Entry, ...]:
    return tuple(
        [
            new_entry(
                item.name,
                item.value,
                _at(item.location, chain),
                _at(item.key, chain),
                item.slot,
                item.opens,
                tuple([_at(place, chain) for place in item.items]) if item.items else (),
            )
            for item in section.entries
        ]
    )


def _at(location: Location, chain: tuple[Span, ...]) -> Location:
    around = location.included_from
    return new_location(location.span, (*around, *chain) if around else chain)


def entry(name: str, value: ParameterValue | None, location: Location) -> Entry:
    """Return an entry that was not read from a file: flat, its name and value written in one place."""
    return new_entry(name, value, location, location, name)
