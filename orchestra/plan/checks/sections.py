"""Sections of parameter files that are for no node, where they were meant for one that the file is given to.

Files that are shared have sections for nodes that a description does not start: such are left alone. A mistake is a
section that stands where one for a node is missing: the only one of a file, one for the same name in another
namespace, one whose name is that of the node mistyped, with its words in another order or without `node`, or that of
the node's program, and the only one without a node where a single node is without one and is about the same. What
is missing without any such is told at the reference.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.errors import Code
from orchestra.fields import field
from orchestra.plan.checks.section_keys import absolute, is_for_any, is_one_key, key_for, outer_key, words_of
from orchestra.plan.ids import full_names, node_name
from orchestra.resolve.model import FileParameters, ResolvedProcess
from orchestra.resolve.rcl.indexed import Indexed
from orchestra.resolve.rcl.patterns import matches
from orchestra.resolve.typos import is_typo

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping, Sequence

    from orchestra.errors import Problems
    from orchestra.plan.model import Plan
    from orchestra.resolve.model import Resolved, ResolvedComponent
    from orchestra.resolve.rcl.sections import Section

    _Node: TypeAlias = "ResolvedProcess | ResolvedComponent"


_MOST = 100
_SHORTEST = 3  # letters of a word that says what a node is about
_MADE = "${run}/"  # what code of a launch file has written is nothing to show


@dataclass(slots=True)
class _File:
    """A parameter file and the nodes that it is given to, by their full names; `open`: one has no known name."""

    source: FileParameters
    users: dict[str, tuple[FileParameters, _Node]] = field(default_factory=dict)
    open: bool = False

    def program(self, name: str) -> tuple[str | None, ...]:
        """Return the package and the executable of a node that is a process."""
        node = self.users[name][1]
        return (node.package, node.executable) if isinstance(node, ResolvedProcess) else ()


def check_sections(resolved: Resolved, plan: Plan, problems: Problems) -> None:
    """Report sections that miss their node, and files that have nothing for a node."""
    del plan
    nodes: list[_Node] = [*resolved.processes, *resolved.components]
    given = [place for place, node in enumerate(nodes) if FileParameters in map(type, node.parameters)]
    if not given:
        return
    full = [*full_names(resolved.processes), *map(node_name, resolved.components)]
    files = _files([(nodes[place], full[place]) for place in given])
    names = _Names(full)
    told: set[object] = set()
    for file in files:
        _check(file, names, resolved, problems, told)


class _Names:
    """The full names of all nodes, and which patterns match any."""

    def __init__(self, names: Iterable[str | None]) -> None:
        self._names = frozenset(name for name in names if name is not None)
        self._known: dict[str, bool] = {}

    def any(self, pattern: str) -> bool:
        """Return whether a pattern matches a node."""
        if "*" not in pattern:
            return absolute(pattern) in self._names
        if pattern not in self._known:
            last = pattern.rpartition("/")[2]
            names: Collection[str] = self._names if "*" in last else self._lasts.get(last, ())
            around = absolute(pattern).partition("/*")[0]
            if around and len(names) > 1:
                names = min(names, self._below.get(around, ()), key=len)
            self._known[pattern] = any(matches(pattern, name) for name in names)
        return self._known[pattern]

    @cached_property
    def _lasts(self) -> dict[str, list[str]]:
        """The names by their last words."""
        lasts: dict[str, list[str]] = {}
        for name in self._names:
            lasts.setdefault(name.rpartition("/")[2], []).append(name)
        return lasts

    @cached_property
    def _below(self) -> dict[str, list[str]]:
        """The names by each that they are or stand below: patterns may begin with as many namespaces as there are."""
        below: dict[str, list[str]] = {}
        for name in self._names:
            for end, character in enumerate(f"{name}/"):
                if end and character == "/":
                    below.setdefault(name[:end], []).append(name)
        return below


def _files(nodes: Sequence[tuple[_Node, str | None]]) -> list[_File]:
    """Return the files with the nodes that each is given to; one for all nodes of a scope is a file of its own."""
    files: dict[tuple[str, object], _File] = {}
    for node, name in nodes:
        if _hands_on(node):
            continue
        for source in node.parameters:
            if type(source) is not FileParameters or not source.sections:
                continue
            place = source.location if source.everywhere else None
            file = files.get((source.path, place))
            if file is None:
                file = files[source.path, place] = _File(source)
            if name is None:
                file.open = True
            elif name not in file.users:
                file.users[name] = (source, node)
    return list(files.values())


def _hands_on(node: _Node) -> bool:
    """Return whether a node may be given files for others: a container has those of its components."""
    return isinstance(node, ResolvedProcess) and (
        node.kind == "container" or node.executable.startswith("component_container")
    )


def _check(file: _File, names: _Names, resolved: Resolved, problems: Problems, told: set[object]) -> None:
    sections = file.source.sections
    exact = {absolute(section.pattern) for section in sections}
    index = Indexed(sections)
    idle: dict[str, list[Section]] = {}
    for section in sections:
        if not names.any(section.pattern):
            idle.setdefault(section.pattern.rpartition("/")[2], []).append(section)
    without: list[str] = []
    narrow = next((section for section in idle.get("*", ()) if is_for_any(section.pattern)), None)
    if narrow is not None and file.users and not file.open:
        name = next((name for name in file.users if name not in exact), next(iter(file.users)))
        _report(narrow, name, key_for(narrow, name), file, problems, told)
    for name in file.users:
        if name in exact:
            continue
        served = narrow is not None or index.has_wildcard_for(name)
        meant = None
        if idle and not file.open:
            programs = file.program(name)
            meant = _meant(name, idle, served=served, resolved=resolved)
            meant = meant or (_of_program if served else _renamed)(name, programs, idle)
        if meant is not None:
            _report(meant, name, key_for(meant, name), file, problems, told)
        elif not served:
            without.append(name)
    _report_rest(file, without, idle, problems, told)


def _report_rest(
    file: _File,
    without: Sequence[str],
    idle: Mapping[str, Sequence[Section]],
    problems: Problems,
    told: set[object],
) -> None:
    """Report nodes that have no section: the one of several at the one section that is over, all where they are."""
    if file.open:
        return
    over = [section for sections in idle.values() for section in sections]
    if len(without) == len(over) == 1 < len(file.users):
        name = without[0]
        if _is_about(over[0], name, file.program(name)):
            _report(over[0], name, key_for(over[0], name), file, problems, told)
    elif len(without) == len(file.users):
        _report_without(file, without, problems, told, idle=bool(idle))


def _meant(
    name: str, idle: Mapping[str, Sequence[Section]], *, served: bool, resolved: Resolved
) -> Section | None:
    """Return the section that was meant for a node, None where none plainly was; `idle` are those of no node by name.

    In a file with very many of them no slip is looked for: it is one for a whole fleet.
    """
    namespace, _, own = name.rpartition("/")
    for section in idle.get(own, ()):
        there = absolute(section.pattern).rpartition("/")[0]
        if there != namespace and (not there or not served):
            return section  # beside a wildcard, one for another namespace is for another robot
    if len(idle) > _MOST:
        return None
    for last, sections in idle.items():
        if last in resolved.lost or not is_typo(last, own):
            continue
        for section in sections:
            if absolute(section.pattern).rpartition("/")[0] in ("", "/**", namespace):
                return section
    return None


def _renamed(
    name: str, programs: Sequence[str | None], idle: Mapping[str, Sequence[Section]]
) -> Section | None:
    """Return the one section whose name has the words of a node's, or is that of its program; None for several."""
    namespace, _, own = name.rpartition("/")
    words = words_of(own)
    found = [
        section
        for last, sections in idle.items()
        if len(idle) <= _MOST and (last in programs or words_of(last) == words)
        for section in sections
        if absolute(section.pattern).rpartition("/")[0] in ("", "/**", namespace)
    ]
    return found[0] if len(found) == 1 else None


def _of_program(
    name: str, programs: Sequence[str | None], idle: Mapping[str, Sequence[Section]]
) -> Section | None:
    """Return the one section that is called as the program of a node, in its very namespace; None for several.

    One that names no namespace may be for a node of another description.
    """
    namespace = name.rpartition("/")[0]
    found = [
        section
        for section in idle.get(programs[-1] or "" if programs else "", ())
        if namespace and absolute(section.pattern).rpartition("/")[0] == namespace
    ]
    return found[0] if len(found) == 1 else None


def _is_about(section: Section, name: str, programs: Sequence[str | None]) -> bool:
    """Return whether a section that is over has a word in common with a node that lacks one, or with its program."""
    namespace, _, own = name.rpartition("/")
    there, _, last = absolute(section.pattern).rpartition("/")
    words = {word for text in (own, *programs) if text is not None for word in words_of(text)}
    return there in ("", "/**", namespace) and any(
        len(word) >= _SHORTEST and word in words for word in words_of(last)
    )


def _report(
    section: Section,
    name: str,
    instead: str | None,
    file: _File,
    problems: Problems,
    told: set[object],
) -> None:
    place, given_at = section.location, file.users[name][0].location
    if place.span in told:
        return
    if instead is None and (outer := outer_key(section, name, file.source.path)) is not None:
        told.add(place.span)
        place, instead = outer
        if place.span in told:
            return
    told.add(place.span)
    if place.span.file.startswith(_MADE):
        place, instead = given_at, None
    message = f"no node is called '{absolute(section.pattern)}', and '{name}' is given this file"
    notes = [f"it is given at {given_at}"]
    if instead is None:
        notes.append(f"did you mean '{name}'?")
    problems.warning(Code.UNMATCHED_SECTION, message, place, suggestion=instead, notes=notes)


def _report_without(
    file: _File, names: Sequence[str], problems: Problems, told: set[object], *, idle: bool
) -> None:
    """Report nodes for which a file has nothing: at its one section, else where the file is given to the node."""
    sections = file.source.sections
    if len(sections) == 1 and len(names) == len(file.users) and idle and not file.open:
        alone = names[0] if len(names) == 1 else "/**"
        if alone == names[0] and not sections[0].pattern.startswith("/"):
            alone = alone.removeprefix("/")  # as the key was written; rcl takes both
        if "*" in sections[0].pattern.rpartition("/")[2]:
            alone = key_for(sections[0], names[0]) or alone
        instead = alone if is_one_key(sections[0]) else None
        _report(sections[0], names[0], instead, file, problems, told)
        return
    patterns = list(dict.fromkeys(section.pattern for section in sections))
    for name in names:
        whom = "any node" if file.source.everywhere else f"'{name}'"
        problems.warning(
            Code.UNMATCHED_SECTION,
            f"the parameter file has no section for {whom}",
            file.users[name][0].location,
            notes=("it has " + ", ".join(f"'{pattern}'" for pattern in patterns),),
        )
        if file.source.everywhere:
            return
