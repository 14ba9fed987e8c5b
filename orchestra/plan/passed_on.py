"""What the parameter file of a process passes on: sections that other nodes in it may read.

What is for a node that another process of the plan is, is not among them. A file with a section for each of a thousand
nodes would be passed on a thousand times else, and a change of one section would concern them all.
"""

from __future__ import annotations

from functools import cached_property, partial
from typing import TYPE_CHECKING

from orchestra.plan.ids import node_name
from orchestra.plan.parameter_file import line, with_lines
from orchestra.resolve.model import FileParameters, InlineParameter
from orchestra.resolve.rcl.indexed import Indexed, absolute
from orchestra.resolve.rcl.sections import Entry, Section, entry
from orchestra.resolve.rcl.table import alone, flat, tabulated

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Container, Iterable, Sequence
    from typing import TypeAlias

    from orchestra.plan.layers import Layers
    from orchestra.plan.model import ParameterFile
    from orchestra.resolve.model import Resolved, ResolvedComponent, ResolvedProcess

    # Of a file that is passed on: the text, or what makes it when somebody asks for it.
    Content: TypeAlias = "str | Callable[[ParameterFile], str]"
    _Block: TypeAlias = "tuple[str, Collection[str], list[str] | None]"

EVERY_NODE = "/**"


class Sections:
    """The sections that nodes of one plan are given. Files, and what is passed on of them, are gone through once."""

    def __init__(self, resolved: Resolved, nodes: Container[str | None]) -> None:
        """Take the full names of the nodes that processes are."""
        self.given = tuple(section for item in resolved.given for section in item.sections)
        self._resolved = resolved  # what is known by its identity stays, as long as anything is asked for
        self._nodes = nodes
        self._files: dict[int, Indexed] = {}
        self._others: dict[int, _Others] = {}
        self._passed_on: dict[tuple[object, ...], str] = {}
        self._alike: dict[tuple[int, ...], Content | None] = {}
        # By identities: entries and sections are kept, so that no others get theirs.
        self._lines: dict[tuple[str, int], tuple[Entry, str]] = {}
        self._blocks: dict[int, tuple[Section, _Block]] = {}

    def for_node(self, node: ResolvedProcess, own: str, full: str | None) -> list[Section]:
        """Return everything on upstream's command line that is for a node: for all nodes, then its own.

        Where its full name is not known, that is only what is for every node.
        """
        found = [section for source in node.parameter_arguments for section in self.of_file(source, full)]
        for source in node.parameters:
            if isinstance(source, InlineParameter):
                found.append(_section(source, own))
            else:
                found += self.of_file(source, full)
        return found

    def of_file(self, source: FileParameters, full: str | None) -> list[Section]:
        """Return the sections of a file that are for a node."""
        return self._matching(source.sections, full)

    @cached_property
    def layers(self) -> Layers:
        """What these come to in nodes where it is plain."""
        # Here, because many plans have no files.
        from orchestra.plan.layers import Layers  # noqa: PLC0415

        return Layers(self._index, partial(_section, own=EVERY_NODE))

    def given_to(self, node: ResolvedProcess | ResolvedComponent) -> list[Section]:
        """Return the sections of the command line that are for a node."""
        return self._matching(self.given, node_name(node)) if self.given else []

    def passed_on(self, node: ResolvedProcess, own: str) -> Content | None:
        """Return the sections that other nodes in the process may read, merged as rcl merges them, in order.

        Of a node whose full name is not known its own sections are among them, and of one without a name all are.
        None where there are none.
        """
        given = tuple(
            [id(item.sections) if type(item) is FileParameters else id(item) for item in node.parameters]
        )
        if given in self._alike:
            return self._alike[given]
        content = self._of_node(node, own)
        if not self.given and all(map(self._is_for_any, node.parameters)):
            self._alike[given] = content
        return content

    def _of_node(self, node: ResolvedProcess, own: str) -> Content | None:
        known = own != EVERY_NODE
        sources = [item for item in node.parameters if not _is_own(item)] if known else node.parameters
        if not (sources or self.given):
            return None
        name = None if node.name is None else node.name.text
        if not known and any(type(item) is InlineParameter and item.value is not None for item in sources):
            # No other node has these, and there is something in it.
            return partial(self._content, sources, own, name, known)
        # Where nothing is for it alone, a node is as one whose full name is known.
        unlike = not known and (
            name is None or self.given or any(self._is_named(name, item) for item in sources)
        )
        key = (
            name if unlike else True,
            *[id(item if isinstance(item, InlineParameter) else item.sections) for item in sources],
        )
        if key not in self._passed_on:
            self._passed_on[key] = self._content(sources, own, name, known)
        return self._passed_on[key] or None

    def _content(
        self,
        sources: Sequence[InlineParameter | FileParameters],
        own: str,
        name: str | None,
        known: bool,
        _file: ParameterFile | None = None,
    ) -> str:
        content = None if self.given else self._plainly(sources, own, name, known=known)
        if content is None:
            every = [section for item in sources for section in self._of(item, own, name, known=known)]
            every += self._kept(self.given, name, known=known)
            content = self._rendered(every)
        return content

    def _plainly(
        self, sources: Sequence[InlineParameter | FileParameters], own: str, name: str | None, *, known: bool
    ) -> str | None:
        """Return the text of what is written once for each pattern; None where it takes a closer look."""
        lines: dict[str, list[str]] = {}
        taken: dict[str, set[str]] = {}
        for source in sources:
            if isinstance(source, InlineParameter):
                if source.value is None:
                    return None
                text = line(source.name, source.value)
                blocks: Iterable[_Block] = (
                    (EVERY_NODE if source.everywhere else own, (source.name,), [text]),
                )
            else:
                blocks = map(self._block, self._kept(source.sections, name, known=known))
            for pattern, names, texts in blocks:
                before = taken.get(pattern)
                if texts is None or not (before is None or before.isdisjoint(names)):
                    return None
                if before is None:
                    taken[pattern], lines[pattern] = set(names), [*texts]
                else:
                    before.update(names)
                    lines[pattern] += texts
        return "".join([with_lines(absolute(pattern), texts) for pattern, texts in lines.items() if texts])

    def _block(self, section: Section) -> _Block:
        """Return the pattern of a section, all names that it takes and its lines, None where some are in the way."""
        section = section.shared
        known = self._blocks.get(id(section))
        if known is None:
            entries = alone(section)
            texts = entries and [self._line(name, entry) for name, entry in entries[0].items()]
            known = self._blocks[id(section)] = (
                section,
                (section.pattern, entries[1] if entries else (), texts),
            )
        return known[1]

    def _rendered(self, sections: Sequence[Section]) -> str:
        texts = []
        for pattern, entries in _winners(sections):
            lines = [
                self._line(name, entry)
                for name, entry in entries
                if entry is not None and entry.value is not None
            ]
            if lines:
                texts.append(with_lines(absolute(pattern), lines))
        return "".join(texts)

    def _line(self, name: str, entry: Entry) -> str:
        """Return the line of an entry; most are passed on to many nodes."""
        known = self._lines.get((name, id(entry)))
        if known is None:
            assert entry.value is not None  # noqa: S101 - asked by the caller
            known = self._lines[name, id(entry)] = (entry, line(name, entry.value))
        return known[1]

    def _of(
        self, source: InlineParameter | FileParameters, own: str, name: str | None, *, known: bool
    ) -> Sequence[Section]:
        if isinstance(source, InlineParameter):
            return (_section(source, own),)
        return self._kept(source.sections, name, known=known)

    def _kept(self, sections: tuple[Section, ...], name: str | None, *, known: bool) -> Sequence[Section]:
        """Return the sections that are passed on of a file, or of the command line."""
        if name is None:
            return sections
        others = self._others_of(sections)
        return others.sections if known else others.with_those_of(name)

    def _is_named(self, name: str, source: InlineParameter | FileParameters) -> bool:
        """Return whether a file has a section that is for a node of this name alone."""
        return type(source) is FileParameters and name in self._others_of(source.sections).named

    def _is_for_any(self, source: InlineParameter | FileParameters) -> bool:
        """Return whether of a source the same is passed on for whatever node."""
        return not (
            _is_own(source) if isinstance(source, InlineParameter) else self._others_of(source.sections).named
        )

    def _others_of(self, sections: tuple[Section, ...]) -> _Others:
        others = self._others.get(id(sections))
        if others is None:
            others = self._others[id(sections)] = _Others(sections, self._nodes)
        return others

    def _index(self, sections: tuple[Section, ...]) -> Indexed:
        index = self._files.get(id(sections))
        if index is None:
            index = self._files[id(sections)] = Indexed(sections)
        return index

    def _matching(self, sections: tuple[Section, ...], full: str | None) -> list[Section]:
        index = self._index(sections)
        return index.everywhere() if full is None else index.matching(full)


class _Others:
    """The sections of a file that are for nobody's node in particular, and the rest of them by names of nodes."""

    def __init__(self, every: Sequence[Section], nodes: Container[str | None]) -> None:
        self._every = every
        self._places: list[int] = []
        self.named: dict[str, list[int]] = {}
        for place, section in enumerate(every):
            full = absolute(section.pattern)
            places = self.named.setdefault(full.rpartition("/")[2], []) if full in nodes else self._places
            places.append(place)
        self.sections = [every[place] for place in self._places]

    def with_those_of(self, name: str) -> Sequence[Section]:
        """Return also those for nodes of a name, in order: one whose namespace is not known may be any of them."""
        own = self.named.get(name)
        return self.sections if own is None else [self._every[place] for place in sorted(self._places + own)]


def _is_own(source: InlineParameter | FileParameters) -> bool:
    return isinstance(source, InlineParameter) and not source.everywhere


def _section(source: InlineParameter, own: str) -> Section:
    item = entry(source.name, source.value, source.location)
    return Section(EVERY_NODE if source.everywhere else own, (item,), source.location)


def _winners(sections: Sequence[Section]) -> Iterable[tuple[str, Iterable[tuple[str, Entry | None]]]]:
    """Return what counts of sections by pattern and name."""
    plain = flat(sections)
    if plain is not None:
        return [(pattern, entries.items()) for pattern, entries in plain.items()]
    table = tabulated(sections)
    return [
        (pattern, {slot.name: slot.entry for slot in slots if slot.entry is not None}.items())
        for pattern, slots in table.items()
    ]
