"""Where a parameter of a node is written: its value, the items of a list, and its name, level by level."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.location import Location
from orchestra.resolve.model import FileParameters, InlineParameter

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.plan.model import Component, Process
    from orchestra.resolve.model import Resolved, ResolvedComponent, ResolvedProcess
    from orchestra.resolve.rcl.sections import Section

    Keys = tuple[tuple[str, Location], ...]
    _Index = dict[tuple[str, Location], "Written"]


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


class Places:
    """The places of all parameters; what is said by a file, or for a node, is gone through once."""

    def __init__(self, resolved: Resolved) -> None:
        self._given: _Index = {}
        self._files: dict[int, tuple[object, _Index]] = {}
        self._asked: object = None  # the node that was asked for last
        self._node: object = None
        self._indexes: list[_Index] = []
        for given in resolved.given:
            _add(self._given, given.sections)

    def of(
        self, name: str, node: ResolvedProcess | ResolvedComponent, planned: Process | Component
    ) -> Written:
        """Return where the value of a parameter that counts is written; of a group, one that is in it."""
        # Who asks for one value of a node may do without an index; for the next ones it is made.
        alone = None if self._given or node is self._asked else _alone(name, node)
        self._asked = node
        if alone is not None:
            return Written(alone.location, alone.items, alone.keys)
        candidates = planned.provenance.parameters
        full = (
            name
            if name in candidates
            else next((item for item in candidates if item.startswith(f"{name}.")), name)
        )
        won = next((item for item in candidates.get(full, ()) if item.won), None)
        if won is None:
            return Written()
        if node is not self._node:
            self._node, self._indexes = node, [*self._of_node(node), self._given]
        key = (full, won.location)
        return next((index[key] for index in self._indexes if key in index), Written(won.location))

    def _of_node(self, node: ResolvedProcess | ResolvedComponent) -> Iterator[_Index]:
        """Yield what sets parameters of a node, in order."""
        index: _Index = {}
        for source in (*getattr(node, "parameter_arguments", ()), *node.parameters):
            if isinstance(source, InlineParameter):
                key = (source.name, source.location)
                index.setdefault(key, Written(source.location, source.items, source.keys))
                continue
            yield index
            index = {}
            if id(source.sections) not in self._files:  # other nodes have the same ones
                _add(index, source.sections)
                self._files[id(source.sections)] = source.sections, index
            yield self._files[id(source.sections)][1]
            index = {}
            for entry in source.plain:
                written = Written(entry.location, entry.items, ((entry.name, entry.key),))
                index.setdefault((entry.name, entry.location), written)
        yield index


def _alone(name: str, node: ResolvedProcess | ResolvedComponent) -> InlineParameter | None:
    """Return the one that sets a parameter in a list of nothing but values; None where it takes a closer look."""
    if getattr(node, "parameter_arguments", ()) or FileParameters in map(type, node.parameters):
        return None
    found = [item for item in node.parameters if isinstance(item, InlineParameter) and item.name == name]
    return found[0] if len(found) == 1 else None


def _add(index: _Index, sections: Sequence[Section]) -> None:
    for section in sections:
        groups: dict[str, Location] = {}
        for entry in section.entries:
            if entry.opens:
                groups[entry.name] = entry.key
                continue
            above = [(name, groups[name]) for name in _groups(entry.name) if name in groups]
            written = Written(entry.location, entry.items, (*above, (entry.name, entry.key)))
            index.setdefault((entry.name, entry.location), written)


def _groups(name: str) -> Iterator[str]:
    """Yield the groups that a name is in, the outermost first."""
    at = name.find(".")
    while at >= 0:
        yield name[:at]
        at = name.find(".", at + 1)
