"""What files and single values make of the parameters of a node, where it takes no table of rcl to tell.

Each pattern is a layer: what the sections for it come to one after the other, which is found out once however many
nodes are given the same ones, and what is for the node alone above them. The layer whose pattern appears last counts.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from orchestra.resolve.model import InlineParameter
from orchestra.resolve.rcl.effective import settled
from orchestra.resolve.rcl.table import alone, kind_of, tabulated

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Sequence

    from orchestra.resolve.model import ParameterSource
    from orchestra.resolve.rcl.indexed import Indexed
    from orchestra.resolve.rcl.sections import Section
    from orchestra.values import ParameterValue


class Part(NamedTuple):
    """A section: its values by name, and all names that it takes; `values` is None where some are in the way.

    It is the one that was read for nobody.
    """

    section: Section
    values: dict[str, ParameterValue] | None
    names: Collection[str]


class _Block:
    """What sections of one pattern come to: values by name, and all names that they take.

    A value of a name that is `shared` does not just give way to another one. `following` are the blocks with one more
    section; None where the last value that is written for a parameter would not count, or would be none.
    """

    __slots__ = ("following", "names", "sections", "shared", "values")

    def __init__(
        self,
        sections: tuple[Section, ...],
        values: dict[str, ParameterValue],
        names: Collection[str],
        shared: frozenset[str],
    ) -> None:
        self.sections = sections
        self.values = values
        self.names = names
        self.shared = shared
        self.following: dict[int, _Block | None] = {}

    def behind(self, part: Part) -> _Block | None:
        """Return what it is with one more section."""
        key = id(part)
        if key not in self.following:
            self.following[key] = self._with(part)
        return self.following[key]

    def _with(self, part: Part) -> _Block | None:
        sections = (*self.sections, part.section)
        if part.values is not None and not self.sections:
            return _Block(sections, part.values, part.names, self.shared)
        names = {*self.names, *part.names}
        if part.values is not None and len(names) == len(self.names) + len(part.names):
            return _Block(sections, {**self.values, **part.values}, names, self.shared)
        values: dict[str, ParameterValue] = {}
        for name, setting in settled(sections).items():
            if setting.value is None or setting.overruled is not None:
                return None
            values[name] = setting.value
        if any(not item.opens and item.name not in values for part in sections for item in part.entries):
            return None  # its slot has become that of another parameter
        (slots,) = tabulated(sections).values()
        shared = {slot.name for slot in slots if len(slot.values) > 1 or len(slots.places[slot.name]) > 1}
        return _Block(sections, values, names, frozenset(shared))


class _Layer:
    """What a node has of one pattern: of sections, of its `own`, and of both where it has any of its own."""

    __slots__ = ("_both", "block", "own")

    def __init__(self, block: _Block) -> None:
        self.block = block
        self.own: dict[str, ParameterValue] = {}
        self._both: dict[str, ParameterValue] | None = None

    @property
    def values(self) -> dict[str, ParameterValue]:
        """All values."""
        return self.block.values if self._both is None else self._both

    def take(self, part: Part) -> bool:
        """Put a section behind the others; return whether it is plain what that comes to."""
        block = self.block.behind(part)
        if block is None or not self.own.keys().isdisjoint(part.names):
            return False
        before, self.block = self.block.values, block
        if self._both is not None:
            if [*block.values][: len(before)] != [*before]:
                return False  # what follows the node's own has taken the place of something before it
            self._both.update(block.values)
            self._both.update(self.own)
        return True

    def set(self, name: str, value: ParameterValue) -> bool:
        """Put a value of the node's own behind all others; return whether it is plain what that comes to."""
        if name in self.block.names and not self._gives_way(name, value):
            return False
        if self._both is None:
            self._both = {**self.block.values}
        elif name in self.own:
            return False
        self.own[name] = self._both[name] = value
        return True

    def _gives_way(self, name: str, value: ParameterValue) -> bool:
        """Return whether the value of sections gives way to another one: it has one slot and is of the same kind."""
        before = None if name in self.block.shared else self.block.values.get(name)
        return before is not None and kind_of(before) == kind_of(value)

    def is_apart(self, names: Collection[str]) -> bool:
        """Return whether none of some names is taken here."""
        return self.own.keys().isdisjoint(names) and not any(name in self.block.names for name in names)


class _Given:
    """What sources that are for every node come to, one after the other: the blocks of their patterns, and all values.

    `following` is what they come to with one more, by its identity; None where that one is not for every node.
    """

    __slots__ = ("blocks", "following", "values")

    def __init__(self, blocks: dict[str, _Block]) -> None:
        self.blocks = blocks
        self.values = _merged([block.values for block in blocks.values()])
        self.following: dict[int, _Given | None] = {}


class Layers:
    """The values that nodes of one plan are given. What it knows by its identity is kept by the caller."""

    def __init__(
        self,
        index: Callable[[tuple[Section, ...]], Indexed],
        section: Callable[[InlineParameter], Section],
    ) -> None:
        """Take what finds the sections of a file that are for a node, and what makes one of a value for every node."""
        self._index = index
        self._section = section
        self._nothing = _Block((), {}, (), frozenset())
        self._begin = _Given({})
        self._parts: dict[int, Part] = {}

    def values(
        self, sources: Sequence[ParameterSource], own: str, full: str | None
    ) -> dict[str, ParameterValue] | None:
        """Return what counts of sources in their order, for a node; None where it takes the table to tell."""
        given = self._begin
        for place, source in enumerate(sources):
            key = id(source) if type(source) is InlineParameter else id(source.sections)  # type: ignore[union-attr]
            further = given.following.get(key) or self._with(given, source, key)
            if further is None:
                return self._others(given, sources[place:], own, full)
            given = further
        return given.values

    def _with(self, given: _Given, source: ParameterSource, key: int) -> _Given | None:
        """Return what all comes to with one source more; None where that is not for every node, or not plain."""
        if key in given.following:
            return None
        if isinstance(source, InlineParameter):
            if not source.everywhere:
                return None
        elif not self._index(source.sections).for_all:
            given.following[key] = None
            return None
        layers = _layers(given)
        plain = all(_take(layers, part, self._nothing) for part in self._parts_of(source, "/"))
        blocks = {pattern: layer.block for pattern, layer in layers.items()}
        further = given.following[key] = _Given(blocks) if plain else None
        return further

    def _others(
        self, given: _Given, sources: Sequence[ParameterSource], own: str, full: str | None
    ) -> dict[str, ParameterValue] | None:
        """Return what counts where other sources follow that are not all for every node."""
        layers = _layers(given)
        for source in sources:
            if type(source) is InlineParameter and not source.everywhere:
                if source.value is None or not _set(layers, own, source, self._nothing):
                    return None
            elif not all(_take(layers, part, self._nothing) for part in self._parts_of(source, full)):
                return None
        return _merged([layer.values for layer in layers.values()])

    def _parts_of(self, source: ParameterSource, full: str | None) -> Sequence[Part]:
        """Return the sections that are for a node, each with what it sets."""
        if isinstance(source, InlineParameter):
            known = self._parts.get(id(source))
            if known is None:
                known = self._parts[id(source)] = _part(self._section(source))
            return (known,)
        index = self._index(source.sections)
        return list(map(self.part, index.everywhere() if full is None else index.matching(full)))

    def part(self, section: Section) -> Part:
        """Return a section with what it sets."""
        section = section.shared
        known = self._parts.get(id(section))
        if known is None:
            known = self._parts[id(section)] = _part(section)
        return known


def _part(section: Section) -> Part:
    entries = alone(section)
    if entries is None:
        return Part(section, None, {name for item in section.entries for name in (item.name, item.slot)})
    values = {name: item.value for name, item in entries[0].items() if item.value is not None}
    return Part(section, values, entries[1])


def _layers(given: _Given) -> dict[str, _Layer]:
    return {pattern: _Layer(block) for pattern, block in given.blocks.items()}


def _take(layers: dict[str, _Layer], part: Part, nothing: _Block) -> bool:
    """Put a section in its layer; return whether it is plain what that comes to."""
    layer = _layer(layers, part.section.pattern, part.names, nothing)
    return layer is not None and layer.take(part)


def _set(layers: dict[str, _Layer], pattern: str, source: InlineParameter, nothing: _Block) -> bool:
    """Put a value in the layer of the node's own; return whether it is plain what that comes to."""
    layer = _layer(layers, pattern, (source.name,), nothing)
    return layer is not None and layer.set(source.name, source.value)


def _layer(layers: dict[str, _Layer], pattern: str, names: Collection[str], nothing: _Block) -> _Layer | None:
    """Return the layer of a pattern; None where names that come to it now are in one that counts more."""
    layer = layers.get(pattern)
    if layer is None:
        layer = layers[pattern] = _Layer(nothing)
        return layer
    for other in reversed(layers.values()):
        if other is layer:
            return layer
        if not other.is_apart(names):
            return None
    return layer


def _merged(values: Sequence[dict[str, ParameterValue]]) -> dict[str, ParameterValue]:
    """Return all values, the last one of each name: what there is alone as it is."""
    if len(values) == 1:
        return values[0]
    merged: dict[str, ParameterValue] = {}
    for some in values:
        merged.update(some)
    return merged
