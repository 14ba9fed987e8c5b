"""What rcl keeps of all sections of a command line: a table of slots per pattern.

The places where it surprises: an entry of a nested mapping takes over the slot of the mapping's own name, and a slot
keeps one value for each kind, of which a node takes the first in the order of `_KINDS`, whichever came last.
Source: `rcl_yaml_param_parser` (`parse_key`, `parse_value`), rclpy and rclcpp for the order of kinds; measured.
"""

from __future__ import annotations

from bisect import insort
from typing import TYPE_CHECKING, Final, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.resolve.rcl.sections import Entry, Section

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator

    from orchestra.values import ParameterValue

_WORDS: Final[dict[type, str]] = {bool: "boolean", int: "integer", float: "float", str: "text"}
_KINDS: Final = (*_WORDS.values(), *(f"list of {word}" for word in _WORDS.values()))

Table: TypeAlias = "dict[str, Slots]"


@dataclass(slots=True)
class Slot:
    """A parameter of a pattern: its name, and the last value of each kind that was set."""

    name: str
    values: dict[str, Entry] = field(default_factory=dict)

    @property
    def entry(self) -> Entry | None:
        """The entry whose value a node takes, None where none has set a value."""
        return next((self.values[kind] for kind in _KINDS if kind in self.values), None)


@dataclass(slots=True)
class Slots:
    """The slots of one pattern in order. Names change and need not be unique; the first slot of a name is found."""

    every: list[Slot] = field(default_factory=list)
    places: dict[str, list[int]] = field(default_factory=dict)

    def __iter__(self) -> Iterator[Slot]:
        return iter(self.every)

    def named(self, name: str) -> Iterator[Slot]:
        """Yield the slots of a name, in order."""
        return (self.every[place] for place in self.places.get(name, ()))

    def put(self, entry: Entry) -> Slot:
        """Put one entry where rcl puts it; return the slot."""
        places = self.places.get(entry.slot)
        if not places:
            self.every.append(Slot(entry.slot))
            places = self.places[entry.slot] = [len(self.every) - 1]
        slot = self.every[places[0]]
        if slot.name != entry.name:
            insort(self.places.setdefault(entry.name, []), places.pop(0))
            slot.name = entry.name
        if entry.value is not None:
            slot.values[kind_of(entry.value)] = entry
        return slot


def tabulated(sections: Iterable[Section]) -> Table:
    """Return the table that rcl makes of sections in the order of the command line."""
    table: Table = {}
    for section in sections:
        slots = table.setdefault(section.pattern, Slots())
        for entry in section.entries:
            slots.put(entry)
    return table


def flat(sections: Iterable[Section]) -> dict[str, dict[str, Entry]] | None:
    """Return the same by pattern and name, where each name has one value and none can take another's slot.

    None where it takes the table to tell. What is nested is so too, as long as nobody else has its names.
    """
    found: dict[str, dict[str, Entry]] = {}
    taken: dict[str, set[str]] = {}
    for section in sections:
        apart = alone(section)
        if apart is None:
            return None
        entries, names = apart
        known = taken.get(section.pattern)
        if known is None:
            found[section.pattern], taken[section.pattern] = dict(entries), set(names)
        elif known.isdisjoint(names):
            found[section.pattern].update(entries)
            known.update(names)
        else:
            return None
    return found


_Alone: TypeAlias = "tuple[dict[str, Entry], Collection[str]] | None"
# By their identities, for it takes long to tell whether two are equal: each is here, so that no other gets its own.
_KNOWN: Final[dict[int, tuple[Section, _Alone]]] = {}
_MOST_KNOWN: Final = 1_000


def alone(section: Section) -> _Alone:
    """Return the entries of a section by name, and all names that it takes; None where some may be in the way."""
    if len(section.entries) == 1:  # as those of values that are given alone
        (entry,) = section.entries
        plain = entry.slot == entry.name and not entry.opens and entry.value is not None
        return ({entry.name: entry}, (entry.name,)) if plain else None
    known = _KNOWN.get(id(section))
    if known is None:
        if len(_KNOWN) >= _MOST_KNOWN:
            _KNOWN.clear()
        known = _KNOWN[id(section)] = (section, _looked_through(section))
    return known[1]


def _looked_through(section: Section) -> _Alone:
    written = [entry for entry in section.entries if not entry.opens]
    slots = [slot for slots in tabulated((section,)).values() for slot in slots]
    entries = {slot.name: slot.entry for slot in slots}
    if not len(written) == len(slots) == len(entries):
        return None
    if any(entry.value is None or entries.get(entry.name) is not entry for entry in written):
        return None
    names = {name for entry in section.entries for name in (entry.name, entry.slot)}
    return {name: entry for name, entry in entries.items() if entry is not None}, names


def counting(values: Iterable[ParameterValue]) -> ParameterValue | None:
    """Return the value that a node takes from a slot that got these, None for none."""
    kinds = {kind_of(value): value for value in values}
    return next((kinds[kind] for kind in _KINDS if kind in kinds), None)


def kind_of(value: ParameterValue) -> str:
    """Return the name of a value's type."""
    return f"list of {_WORDS[type(value[0])]}" if isinstance(value, tuple) else _WORDS[type(value)]
