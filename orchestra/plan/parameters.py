"""The effective parameters of a node: what rcl would make of the command line that upstream would have built."""

from __future__ import annotations

from dataclasses import field
from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.errors import Code, Problems
from orchestra.nearest import nearest
from orchestra.plan import candidates
from orchestra.plan.absent import is_mistake
from orchestra.plan.ids import node_name
from orchestra.plan.model import Candidate, ParameterFile
from orchestra.plan.parameter_file import rendered
from orchestra.resolve.model import InlineParameter
from orchestra.resolve.rcl.effective import effective
from orchestra.resolve.rcl.patterns import matches
from orchestra.resolve.rcl.sections import Section, entry
from orchestra.resolve.rcl.table import tabulated
from orchestra.values import ParameterValue

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from orchestra.resolve.model import (
        GivenSections,
        Resolved,
        ResolvedComponent,
        ResolvedProcess,
    )
    from orchestra.resolve.rcl.effective import Setting


_EVERY_NODE = "/**"


@dataclass(frozen=True, slots=True)
class Parameters:
    """What a node gets: values by name, all that was written for each, and what goes to other nodes in the process."""

    values: dict[str, ParameterValue] = field(default_factory=dict)
    candidates: dict[str, tuple[Candidate, ...]] = field(default_factory=dict)
    files: tuple[ParameterFile, ...] = ()


def parameters_of(process: ResolvedProcess, given: Sequence[GivenSections], problems: Problems) -> Parameters:
    """Return the effective parameters of a process; those of the command line win over all others.

    A surprise is reported: a value that loses although it stands last.
    """
    if process.kind == "process":
        return Parameters()
    full = node_name(process)
    own = full if full is not None and process.namespace is not None else _EVERY_NODE
    sections = _sections(process, own)
    settings = settings_of(sections, full)
    overrides = settings_of([section for item in given for section in item.sections], full)
    _report(settings, overrides, problems)
    known = candidates.origins(process.parameters)
    every = [*sections, *(section for item in given for section in item.sections)]
    return Parameters(
        {
            name: setting.value
            for name, setting in {**settings, **overrides}.items()
            if setting.value is not None
        },
        {
            name: candidates.of_parameter(settings.get(name), overrides.get(name), known)
            for name in {**settings, **overrides}
        },
        _passed_on(every, None if own == _EVERY_NODE else own),
    )


def check_given(resolved: Resolved, problems: Problems) -> None:
    """Report parameters of the command line that are for no node of the description."""
    names = _names(resolved)
    anonymous = any(process.kind != "process" and process.name is None for process in resolved.processes)
    for given in resolved.given:
        for section in given.sections:
            if any(matches(section.pattern, name) for name in names) or (anonymous and not given.strict):
                continue
            if not is_mistake(section.pattern, names, resolved):
                continue
            report = problems.error if given.strict else problems.warning
            message = f"there is no node '{section.pattern}' to give parameters to"
            suggestion = nearest(section.pattern, names)
            report(Code.UNMATCHED_SECTION, message, section.location, suggestion=suggestion)


def _nodes(resolved: Resolved) -> list[ResolvedProcess | ResolvedComponent]:
    nodes = (process for process in resolved.processes if process.kind != "process")
    return [*nodes, *resolved.components]


def _names(resolved: Resolved) -> list[str]:
    return [name for node in _nodes(resolved) if (name := node_name(node)) is not None]


def _sections(process: ResolvedProcess, own: str) -> list[Section]:
    """Return everything on upstream's command line, in its order: for all nodes, then the node's own."""
    sections: list[Section] = []
    for source in process.parameters:
        if isinstance(source, InlineParameter):
            pattern = _EVERY_NODE if source.everywhere else own
            item = entry(source.name, source.value, source.location)
            sections.append(Section(pattern, (item,), source.location))
        else:
            sections += source.sections
    return sections


def settings_of(sections: Sequence[Section], full: str | None) -> dict[str, Setting]:
    """Return what counts in a node of this full name; where that is not known, only what is for every node."""
    if full is not None:
        return effective(sections, full)
    return effective([section for section in sections if section.pattern.lstrip("/") == "**"], "/_")


def _report(settings: dict[str, Setting], overrides: dict[str, Setting], problems: Problems) -> None:
    for name, setting in {**settings, **overrides}.items():
        if setting.value is None and setting.written:
            message = f"'{name}' has no type here: an empty list or mapping"
            problems.error(Code.PARAMETER_TYPE, message, setting.written[-1].location)
        if setting.overruled is not None and name not in overrides:
            winner = next(item for item in setting.written if item.won)
            problems.warning(
                Code.OVERRULED_PARAMETER,
                f"this value of '{name}' does not count, although it stands last: {setting.rule}",
                setting.overruled.location,
                notes=(f"the value that counts is at {winner.location}",),
            )


def _passed_on(sections: Iterable[Section], own: str | None) -> tuple[ParameterFile, ...]:
    """Return the sections that other nodes in the process may read, merged as rcl merges them, in order.

    For a node whose full name is not known (`own` is None) these are all sections.
    """
    texts = []
    for pattern, slots in tabulated(sections).items():
        if own is not None and pattern.lstrip("/") == own.lstrip("/"):
            continue
        values = {
            slot.name: slot.entry.value
            for slot in slots
            if slot.entry is not None and slot.entry.value is not None
        }
        if values:
            texts.append(rendered(pattern if pattern.startswith("/") else f"/{pattern}", values))
    return (ParameterFile("", "".join(texts)),) if texts else ()
