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
from orchestra.resolve.rcl.sections import Entry

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from orchestra.resolve.rcl.sections import Section
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


def counting(values: Iterable[ParameterValue]) -> ParameterValue | None:
    """Return the value that a node takes from a slot that got these, None for none."""
    kinds = {kind_of(value): value for value in values}
    return next((kinds[kind] for kind in _KINDS if kind in kinds), None)


def kind_of(value: ParameterValue) -> str:
    """Return the name of a value's type."""
    return f"list of {_WORDS[type(value[0])]}" if isinstance(value, tuple) else _WORDS[type(value)]
