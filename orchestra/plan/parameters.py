"""The effective parameters of a node: what rcl would make of the command line that upstream would have built."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from operator import attrgetter
from typing import TYPE_CHECKING, Any, Final

from orchestra.dataclass import dataclass, maker
from orchestra.errors import Code, Problems
from orchestra.fields import field
from orchestra.nearest import nearest
from orchestra.plan import candidates
from orchestra.plan.absent import is_mistake
from orchestra.plan.ids import node_name
from orchestra.plan.model import Candidate, ParameterFile, new_candidate
from orchestra.plan.parameter_file import rendered
from orchestra.plan.passed_on import EVERY_NODE, Sections
from orchestra.resolve.model import FileParameters, InlineParameter
from orchestra.resolve.rcl.effective import effective
from orchestra.resolve.rcl.indexed import absolute
from orchestra.resolve.rcl.patterns import matches
from orchestra.resolve.rcl.table import alone
from orchestra.values import ParameterValue

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.plan.passed_on import Content
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

    That is the content of the file that is `passed`, or what makes it. Where they are not `is_passed` all of them are
    on the node's command line as it is.
    """

    values: dict[str, ParameterValue] = field(default_factory=dict)
    written: Callable[[], dict[str, tuple[Candidate, ...]]] = dict
    passed: Any = None
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
    if not (sections.given or process.parameter_arguments):
        plain = _plain(process, own, full, sections, whole=whole)
        if plain is not None:
            return plain
    settings = settings_of(sections.for_node(process, own, full), full)
    overrides = settings_of(sections.given_to(process), full)
    _report(settings, overrides, problems)
    return Parameters(
        {name: item.value for name, item in {**settings, **overrides}.items() if item.value is not None},
        lambda: _candidates(settings, overrides, _origins(process, whole=whole)),
        sections.passed_on(process, own) if whole else None,
        is_passed,
    )


def _candidates(
    settings: dict[str, Setting], overrides: dict[str, Setting], known: candidates.Origins
) -> dict[str, tuple[Candidate, ...]]:
    return {
        name: candidates.of_parameter(settings.get(name), overrides.get(name), known)
        for name in {**settings, **overrides}
    }


_NONE: Final = Parameters()


def _origins(process: ResolvedProcess, *, whole: bool) -> candidates.Origins:
    return candidates.origins((*process.parameter_arguments, *process.parameters) if whole else ())


def _plain(
    process: ResolvedProcess, own: str, full: str | None, sections: Sections, *, whole: bool
) -> Parameters | None:
    """Return the parameters of a node where each is written once; None where it takes a closer look.

    Where the full name is not known, other nodes in the process may read them too.
    """
    parameters = process.parameters
    values = None if FileParameters in map(type, parameters) else _inline_once(parameters)
    passed: Content | None = None
    if values is None:
        values = sections.layers.values(parameters, own, full)
        if values is None:
            return None
        if whole:
            passed = sections.passed_on(process, own)
    elif whole and own == EVERY_NODE:
        passed = partial(_of_every_node, values)

    def written() -> dict[str, tuple[Candidate, ...]]:
        known = _origins(process, whole=whole)
        found = _each_once(parameters, own, full, sections)
        if found is None:
            return _candidates(settings_of(sections.for_node(process, own, full), full), {}, known)
        return {
            name: told
            for pattern, sources in found.items()
            for source in sources
            for name, told in _told(source, f"set for '{pattern}'", known)
        }

    return new_parameters(values, written, passed, True)


new_parameters = maker(Parameters)


def _of_every_node(values: dict[str, ParameterValue], file: ParameterFile) -> str:
    del file
    return rendered(EVERY_NODE, values)


_SETTING: Final = attrgetter("name", "value")
_EVERYWHERE: Final = attrgetter("everywhere")


def _inline_once(parameters: Sequence[ParameterSource]) -> dict[str, ParameterValue] | None:
    """Return the values by their names; None where there are others than those of one node, each once."""
    values: dict[str, ParameterValue] = dict(map(_SETTING, parameters))
    known = len(values) == len(parameters) and None not in values.values()
    return values if known and not any(map(_EVERYWHERE, parameters)) else None


def _each_once(
    parameters: Sequence[ParameterSource], own: str, full: str | None, sections: Sections
) -> dict[str, list[InlineParameter | Section]] | None:
    """Return what sets parameters by pattern, the patterns in the order in which they appear first.

    None where one is written twice, or may take the slot of another, and for files of a node without a name.
    """
    found: dict[str, list[InlineParameter | Section]] = {}
    taken: set[str] = set()
    for source in parameters:
        if type(source) is InlineParameter:
            if source.name in taken or (source.everywhere and source.value is None):
                return None
            taken.add(source.name)
            pattern = EVERY_NODE if source.everywhere else own
            if pattern in found:
                found[pattern].append(source)
            else:
                found[pattern] = [source]
            continue
        if full is None:
            return None
        for section in sections.of_file(source, full):  # type: ignore[arg-type]  # the other kind of source
            part = sections.layers.part(section)
            if part.values is None or not taken.isdisjoint(part.names):
                return None
            taken.update(part.names)
            found.setdefault(section.pattern, []).append(section)
    return found


def _told(
    source: InlineParameter | Section, rule: str, known: candidates.Origins
) -> Iterator[tuple[str, tuple[Candidate, ...]]]:
    """Yield the names of parameters with the one value that is written for each."""
    if isinstance(source, InlineParameter):
        through = candidates.passage(source.through)
        yield source.name, (new_candidate(source.value, source.location, True, rule, through),)
        return
    for name, entry in (alone(source) or ({}, ()))[0].items():
        through = candidates.behind(entry.location, known)
        yield name, (new_candidate(entry.value, entry.location, True, rule, through),)


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
