"""The effective parameters of a node: what rcl would make of the command line that upstream would have built."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.errors import Code, Problems
from orchestra.fields import field
from orchestra.location import is_python
from orchestra.nearest import nearest
from orchestra.plan import candidates
from orchestra.plan.absent import is_mistake
from orchestra.plan.ids import node_name
from orchestra.plan.model import Candidate, ParameterFile
from orchestra.plan.parameter_file import rendered
from orchestra.plan.passed_on import EVERY_NODE, Sections
from orchestra.resolve.model import InlineParameter
from orchestra.resolve.rcl.effective import effective
from orchestra.resolve.rcl.indexed import absolute
from orchestra.resolve.rcl.patterns import matches
from orchestra.values import ParameterValue

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.resolve.model import (
        ParameterSource,
        Resolved,
        ResolvedComponent,
        ResolvedProcess,
    )
    from orchestra.resolve.rcl.effective import Setting
    from orchestra.resolve.rcl.sections import Section


@dataclass(frozen=True, slots=True)
class Parameters:
    """What a node gets: values by name, all that was written for each, and what goes to other nodes in the process.

    Where they are not `is_passed` all of them are on the node's command line as it is.
    """

    values: dict[str, ParameterValue] = field(default_factory=dict)
    candidates: dict[str, tuple[Candidate, ...]] = field(default_factory=dict)
    files: tuple[ParameterFile, ...] = ()
    is_passed: bool = False


def parameters_of(
    process: ResolvedProcess, sections: Sections, problems: Problems, *, whole: bool = True
) -> Parameters:
    """Return the effective parameters of a process; those of the command line win over all others.

    A surprise is reported: a value that loses although it stands last. What is not `whole` lacks what values came
    through, and what goes to other nodes.
    """
    is_passed = bool(process.parameters or sections.given)
    if process.kind == "process" or not (is_passed or process.parameter_arguments):
        return Parameters()
    full = node_name(process)
    own = full if full is not None and process.namespace is not None else EVERY_NODE
    plain = None if sections.given or process.parameter_arguments else _plain(process, own, whole=whole)
    if plain is not None:
        return plain
    settings = settings_of(sections.for_node(process, own, full), full)
    overrides = settings_of(sections.given_to(process), full)
    _report(settings, overrides, problems)
    known = candidates.origins((*process.parameter_arguments, *process.parameters) if whole else ())
    every = {**settings, **overrides}
    return Parameters(
        {name: setting.value for name, setting in every.items() if setting.value is not None},
        {name: candidates.of_parameter(settings.get(name), overrides.get(name), known) for name in every},
        sections.passed_on(process, own) if whole else (),
        is_passed,
    )


def _plain(process: ResolvedProcess, own: str, *, whole: bool) -> Parameters | None:
    """Return the parameters of a node where each is written once, at the node; None where it takes a closer look.

    In Python several may have one place, so that what was read for one is taken for what was read for all. Where the
    full name is not known, other nodes in the process may read them too.
    """
    if is_python(process.location) and not _are_apart(process.parameters):
        return None
    values: dict[str, ParameterValue] = {}
    written: dict[str, tuple[Candidate, ...]] = {}
    rule = f"set for '{own}'"
    for source in process.parameters:
        if not isinstance(source, InlineParameter) or source.everywhere or source.name in values:
            return None
        values[source.name] = source.value
        through = candidates.passage(source.through)
        written[source.name] = (candidates.new_candidate(source.value, source.location, True, rule, through),)
    shared = own == EVERY_NODE and whole and values
    return Parameters(values, written, (ParameterFile("", rendered(own, values)),) if shared else (), True)


def _are_apart(sources: Sequence[ParameterSource]) -> bool:
    """Return whether values have places of their own, as far as that can be told without working the places out.

    Those of arguments differ by their paths, and from all others.
    """
    paths = [getattr(source.location.span, "path", None) for source in sources]
    return len(set(paths)) == len(paths)


def check_given(resolved: Resolved, problems: Problems) -> None:
    """Report parameters of the command line that are for no node of the description."""
    if not resolved.given:
        return
    names = _names(resolved)
    exact = frozenset(names)
    anonymous = any(process.kind != "process" and process.name is None for process in resolved.processes)
    for given in resolved.given:
        for section in given.sections:
            if anonymous and not given.strict:
                continue
            if absolute(section.pattern) in exact or any(matches(section.pattern, name) for name in names):
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


def settings_of(sections: Sequence[Section], full: str | None) -> dict[str, Setting]:
    """Return what counts in a node of this full name; where that is not known, only what is for every node."""
    if not sections:
        return {}
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
