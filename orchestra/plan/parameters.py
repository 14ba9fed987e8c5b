"""The effective parameters of a node: what rcl would make of the command line that upstream would have built."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Final, TypeAlias

from orchestra.dataclass import dataclass, maker
from orchestra.errors import Code, Problems
from orchestra.fields import field
from orchestra.nearest import nearest
from orchestra.plan import candidates
from orchestra.plan.absent import is_mistake
from orchestra.plan.ids import node_name
from orchestra.plan.model import Candidate, ParameterFile, new_candidate, new_file
from orchestra.plan.parameter_file import rendered
from orchestra.plan.passed_on import EVERY_NODE, Sections
from orchestra.resolve.model import InlineParameter
from orchestra.resolve.rcl.effective import effective
from orchestra.resolve.rcl.indexed import absolute
from orchestra.resolve.rcl.patterns import matches
from orchestra.resolve.rcl.table import alone
from orchestra.values import ParameterValue

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.location import Location
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
    """What a node gets: values by name, what tells all that was `written` for each, and what goes to other nodes.

    Where they are not `is_passed` all of them are on the node's command line as it is.
    """

    values: dict[str, ParameterValue] = field(default_factory=dict)
    written: Callable[[], dict[str, tuple[Candidate, ...]]] = dict
    files: tuple[ParameterFile, ...] = ()
    is_passed: bool = False


def parameters_of(
    process: ResolvedProcess, full: str | None, sections: Sections, problems: Problems, *, whole: bool = True
) -> Parameters:
    """Return the effective parameters of a process, by its full name; those of the command line win over all others.

    A surprise is reported: a value that loses although it stands last. What is not `whole` lacks what values came
    through, and what goes to other nodes.
    """
    is_passed = bool(process.parameters or sections.given)
    if process.kind == "process" or not (is_passed or process.parameter_arguments):
        return _NONE
    own = full if full is not None and process.namespace is not None else EVERY_NODE
    plain = (
        None
        if sections.given or process.parameter_arguments
        else _plain(process, own, full, sections, whole=whole)
    )
    if plain is not None:
        return plain
    settings = settings_of(sections.for_node(process, own, full), full)
    overrides = settings_of(sections.given_to(process), full)
    _report(settings, overrides, problems)
    every = {**settings, **overrides}

    def written() -> dict[str, tuple[Candidate, ...]]:
        known = _origins(process, whole=whole)
        return {
            name: candidates.of_parameter(settings.get(name), overrides.get(name), known) for name in every
        }

    return Parameters(
        {name: setting.value for name, setting in every.items() if setting.value is not None},
        written,
        sections.passed_on(process, own) if whole else (),
        is_passed,
    )


_NONE: Final = Parameters()


def _origins(process: ResolvedProcess, *, whole: bool) -> candidates.Origins:
    return candidates.origins((*process.parameter_arguments, *process.parameters) if whole else ())


# The value of a parameter, its place, and whether it is one of a file.
_Single: TypeAlias = "tuple[ParameterValue | None, Location, InlineParameter | None]"


def _plain(
    process: ResolvedProcess, own: str, full: str | None, sections: Sections, *, whole: bool
) -> Parameters | None:
    """Return the parameters of a node where each is written once; None where it takes a closer look.

    Where the full name is not known, other nodes in the process may read them too.
    """
    values = _inline_once(process.parameters)
    if values is None:
        singles = _each_once(process, own, full, sections)
        if singles is None:
            return None
        values = {
            name: value
            for part in singles.values()
            for name, (value, _, _) in part.items()
            if value is not None
        }
    files: tuple[ParameterFile, ...] = ()
    if whole and any(kind is not InlineParameter for kind in set(map(type, process.parameters))):
        files = sections.passed_on(process, own)
    elif whole and values and own == EVERY_NODE:
        files = (new_file("", rendered(own, values)),)

    def written() -> dict[str, tuple[Candidate, ...]]:
        known, found = _origins(process, whole=whole), _each_once(process, own, full, sections) or {}
        return {
            name: _candidate(*single, f"set for '{pattern}'", known)
            for pattern, singles in found.items()
            for name, single in singles.items()
        }

    return new_parameters(values, written, files, True)


new_parameters = maker(Parameters)


def _candidate(
    value: ParameterValue | None,
    at: Location,
    source: InlineParameter | None,
    rule: str,
    known: candidates.Origins,
) -> tuple[Candidate, ...]:
    through = candidates.behind(at, known) if source is None else candidates.passage(source.through)
    return (new_candidate(value, at, True, rule, through),)


def _inline_once(parameters: Sequence[ParameterSource]) -> dict[str, ParameterValue] | None:
    """Return the values of parameters by their names; None where there are others than those of one node, each once."""
    values = {}
    for source in parameters:
        if type(source) is not InlineParameter or source.everywhere or source.value is None:
            return None
        values[source.name] = source.value
    return values if len(values) == len(parameters) else None


def _each_once(
    process: ResolvedProcess, own: str, full: str | None, sections: Sections
) -> dict[str, dict[str, _Single]] | None:
    """Return the parameters by pattern and name, the patterns in the order in which they appear first.

    None where one is written twice, or may take the slot of another. What is set for all nodes is left out of it, and
    files where they are given to a node without a name.
    """
    found: dict[str, dict[str, _Single]] = {}
    taken: set[str] = set()
    for source in process.parameters:
        if type(source) is InlineParameter:
            if source.everywhere or source.name in taken:
                return None
            taken.add(source.name)
            single = (source.value, source.location, source)
            if own in found:
                found[own][source.name] = single
            else:
                found[own] = {source.name: single}
            continue
        if full is None:
            return None
        for section in sections.of_file(source, full):  # type: ignore[arg-type]  # the other kind of source
            entries = alone(section)
            if entries is None or not taken.isdisjoint(entries[1]):
                return None
            taken.update(entries[1])
            singles = found.setdefault(section.pattern, {})
            for name, entry in entries[0].items():
                singles[name] = (entry.value, entry.location, None)
    return found


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
