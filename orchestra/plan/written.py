"""Where a parameter of a node is written: its value, the items of a list, and its name, level by level."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.location import Location
from orchestra.resolve.model import InlineParameter

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.plan.model import Component, Process
    from orchestra.resolve.model import Resolved, ResolvedComponent, ResolvedProcess
    from orchestra.resolve.rcl.sections import Section

    Keys = tuple[tuple[str, Location], ...]


@dataclass(frozen=True, slots=True)
class Key:
    """The place of a name, and what should stand there; `notes` say it where it cannot stand there."""

    location: Location
    meant: str | None = None
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Written:
    """The places of the value that counts; `value` is None where it is not known.

    `keys` are the names it is written with, from the outermost level inwards: each as far as it goes, and its place.
    """

    value: Location | None = None
    items: tuple[Location, ...] = ()
    keys: Keys = ()

    @property
    def is_whole(self) -> bool:
        """Whether the place of the value is all of it, and not the first item of a list."""
        return self.value not in self.items

    def key(self, name: str, meant: str | None) -> Key:
        """Return the place of a name, or of the level that ends as it does, and how `meant` is written there."""
        assert self.value is not None  # noqa: S101 - who asks has looked
        above = ""
        for whole, location in self.keys:
            if whole == name or whole.startswith(f"{name}."):
                instead = None if meant is None else meant + whole[len(name) :]
                if instead is None:
                    return Key(location)
                if instead.startswith(above):
                    return Key(location, instead.removeprefix(above))
                return Key(location, notes=(f"did you mean '{instead}'?",))
            above = f"{whole}."
        return Key(self.value, notes=() if meant is None else (f"did you mean '{meant}'?",))


def written_of(
    name: str, node: ResolvedProcess | ResolvedComponent, planned: Process | Component, resolved: Resolved
) -> Written:
    """Return where the value of a parameter that counts is written; of a group, one that is in it."""
    candidates = planned.provenance.parameters
    full = (
        name
        if name in candidates
        else next((item for item in candidates if item.startswith(f"{name}.")), name)
    )
    won = next((item for item in candidates.get(full, ()) if item.won), None)
    if won is None:
        return Written()
    return next(_places(full, won.location, node, resolved), Written(won.location))


def _places(
    name: str, value: Location, node: ResolvedProcess | ResolvedComponent, resolved: Resolved
) -> Iterator[Written]:
    """Yield the places of everything that sets this name at this place."""
    for source in (*getattr(node, "parameter_arguments", ()), *node.parameters):
        if isinstance(source, InlineParameter):
            if source.name == name and source.location == value:
                yield Written(value, source.items, source.keys)
            continue
        for section in source.sections:
            yield from _in_section(name, value, section)
        for entry in source.plain:
            if entry.name == name and entry.location == value:
                yield Written(value, entry.items, ((name, entry.key),))
    for given in resolved.given:
        for section in given.sections:
            yield from _in_section(name, value, section)


def _in_section(name: str, value: Location, section: Section) -> Iterator[Written]:
    groups: dict[str, Location] = {}
    for entry in section.entries:
        if entry.opens:
            groups[entry.name] = entry.key
        elif entry.name == name and entry.location == value:
            above = [item for item in groups.items() if name.startswith(f"{item[0]}.")]
            yield Written(
                value, entry.items, (*sorted(above, key=lambda item: len(item[0])), (name, entry.key))
            )
