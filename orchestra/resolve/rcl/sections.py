"""The parts of a parameter file as rcl sees them."""

from __future__ import annotations

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


@dataclass(frozen=True, slots=True)
class Section:
    """What one `ros__parameters` mapping sets for the nodes that match a pattern.

    The pattern is as rcl keeps it, nested keys joined with `/`: `ns/n` and `/ns/n` match the same nodes but count as
    two patterns where the order matters. `location` is that of the last key of the pattern: the node's name.
    """

    pattern: str
    entries: tuple[Entry, ...]
    location: Location


def included(section: Section, chain: tuple[Span, ...]) -> Section:
    """Return a section of a file that was read for nobody as that of one which includes led to."""

    def at(location: Location) -> Location:
        around = location.included_from
        return new_location(location.span, (*around, *chain) if around else chain)

    entries = [
        new_entry(
            item.name,
            item.value,
            at(item.location),
            at(item.key),
            item.slot,
            item.opens,
            tuple(map(at, item.items)) if item.items else (),
        )
        for item in section.entries
    ]
    return Section(section.pattern, tuple(entries), at(section.location))


def entry(name: str, value: ParameterValue | None, location: Location) -> Entry:
    """Return an entry that was not read from a file: flat, its name and value written in one place."""
    return new_entry(name, value, location, location, name)
