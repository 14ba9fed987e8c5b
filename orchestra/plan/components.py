"""Components of a plan: which process takes them in, and the parameters that it is told to give them.

A container gets the parameters of a component as one list, of which the last of a name counts. So, other than on a
node's command line, each file counts where it stands (launch_ros, `get_composable_node_load_request`); within a file
rcl's rules hold, all wildcards included, of which upstream knows but one.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from orchestra.errors import Code, Severity
from orchestra.nearest import nearest
from orchestra.plan import candidates
from orchestra.plan.absent import is_mistake
from orchestra.plan.ids import base_identity, node_name
from orchestra.plan.model import Candidate, Component, Provenance, new_component
from orchestra.plan.parameters import settings_of
from orchestra.plan.provenance import naming, remapping_values
from orchestra.plan.remappings import remappings
from orchestra.resolve.model import FileParameters, InlineParameter

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from orchestra.errors import Problems
    from orchestra.location import Location
    from orchestra.plan.passed_on import Sections
    from orchestra.resolve.model import ParameterSource, Resolved, ResolvedComponent, ResolvedProcess
    from orchestra.resolve.rcl.effective import Setting
    from orchestra.values import ParameterValue


def components(
    resolved: Resolved, ids: Sequence[str], own: Sequence[str], sections: Sections, problems: Problems
) -> tuple[Component, ...]:
    """Return the components in order; `ids` are those of the processes, `own` those of the components."""
    if not resolved.components:
        return ()
    containers = _Containers(resolved)
    found = []
    for component, identity in zip(resolved.components, own, strict=True):
        index = containers.index(component)
        if index is None:
            _report_missing(component, containers, resolved, problems)
        process = ids[index] if index is not None else None
        container = _container(component, index, resolved)
        found.append(_component(component, identity, container, process, sections, problems))
    return tuple(found)


class _Containers:
    """The processes by what components may call them."""

    def __init__(self, resolved: Resolved) -> None:
        self.names: dict[str, int] = {}
        self.origins: dict[int, int] = {}
        for index, process in enumerate(resolved.processes):
            name = node_name(process)
            if name is not None:
                self.names.setdefault(name, index)
            if process.origin is not None:
                self.origins.setdefault(id(process.origin), index)

    def index(self, component: ResolvedComponent) -> int | None:
        """Return the index of the process that is the container, None where none of the plan is."""
        if component.container_process is not None:
            return component.container_process
        if component.container is not None:
            return self.names.get(component.container.text)
        return self.origins.get(id(component.container_origin))


def _component(
    component: ResolvedComponent,
    identity: str,
    container: str,
    process: str | None,
    sections: Sections,
    problems: Problems,
) -> Component:
    full = node_name(component)
    rules = remappings(component, problems) if component.remaps else ()
    overrides = settings_of(sections.given_to(component), full)
    return new_component(
        id=identity,
        name=component.name.text if component.name is not None else None,
        namespace=component.namespace.text if component.namespace is not None else None,
        package=component.package,
        plugin=component.plugin,
        container=container,
        process=process,
        condition="event" if component.delayed else "started",
        parameters=_values(component.parameters, full, sections, overrides),
        remappings=rules,
        extra_arguments=_values(component.extra_arguments, full, sections, {}),
        lifecycle="active" if component.autostart else None,
        location=component.location,
        provenance=partial(_provenance, component, full, sections, overrides),  # type: ignore[arg-type]  # made when asked for
        params_schema=None if component.params_schema is None else component.params_schema.text,
    )


def _provenance(
    component: ResolvedComponent,
    full: str | None,
    sections: Sections,
    overrides: Mapping[str, Setting],
    _: Component,
) -> Provenance:
    return Provenance(
        name=component.name.location if component.name is not None else None,
        namespace=component.namespace.location if component.namespace is not None else None,
        parameters=_candidates(component.parameters, full, sections, overrides),
        remappings=tuple(rule.source.location for rule in component.remaps),
        naming=naming(component),
        remapping_values=remapping_values(component),
        params_schema=None if component.params_schema is None else component.params_schema.location,
    )


def _container(component: ResolvedComponent, index: int | None, resolved: Resolved) -> str:
    if index is not None:
        process = resolved.processes[index]
        return node_name(process) or base_identity(process)
    return component.container.text if component.container is not None else ""


def _report_missing(
    component: ResolvedComponent, containers: _Containers, resolved: Resolved, problems: Problems
) -> None:
    """Report a container that is not of this plan. It may be of another launch, which is said where none is like it."""
    if component.faulty:
        return
    if component.container is None:
        message = "the container that this component is loaded into is not started"
        problems.error(Code.UNKNOWN_DEPENDENCY, message, component.location)
        return
    known = containers.names
    if is_mistake(component.container.text, known, resolved):
        message = f"no process of this plan is the container '{component.container.text}'"
        suggestion = nearest(component.container.text, known) or _elsewhere(
            component.container.text, resolved
        )
        at = component.container.location
        if suggestion is not None or any(map(_is_container, resolved.processes)):
            problems.warning(Code.UNKNOWN_DEPENDENCY, message, at, suggestion=suggestion)
        else:
            told = f"{message}; whoever includes this, or another launch, starts it"
            problems.weighed(Severity.NOTE, Code.UNKNOWN_DEPENDENCY, told, at)


def _elsewhere(name: str, resolved: Resolved) -> str | None:
    """Return the container that has a name in another namespace, where it is the only one."""
    last = name.rpartition("/")[2]
    names = {node_name(process) for process in filter(_is_container, resolved.processes)}
    found = [known for known in names if known is not None and known.rpartition("/")[2] == last]
    return found[0] if len(found) == 1 else None


def _is_container(process: ResolvedProcess) -> bool:
    return process.kind == "container" or process.executable.startswith("component_container")


def _candidates(
    sources: Sequence[ParameterSource],
    full: str | None,
    sections: Sections,
    overrides: Mapping[str, Setting],
) -> dict[str, tuple[Candidate, ...]]:
    """Return all that is written for each parameter; the last one counts, the command line's over all others."""
    found: dict[str, list[tuple[ParameterValue | None, Location, str]]] = {}
    for source in sources:
        for name, value, location in _entries(source, full, sections):
            found.setdefault(name, []).append((value, location, "the last one counts"))
    for name, setting in overrides.items():
        for item in sorted(setting.written, key=lambda item: item.won):
            found.setdefault(name, []).append((item.value, item.location, candidates.FROM_COMMAND_LINE))
    known = candidates.origins(sources)
    return {
        name: tuple(
            Candidate(
                value,
                location,
                item is written[-1],
                rule if item is written[-1] else "written before the value that counts",
                candidates.behind(location, known),
            )
            for item in written
            for value, location, rule in (item,)
        )
        for name, written in found.items()
    }


def _entries(
    source: ParameterSource, full: str | None, sections: Sections
) -> Iterator[tuple[str, ParameterValue | None, Location]]:
    if isinstance(source, InlineParameter):
        yield source.name, source.value, source.location
        return
    for entry in source.plain:
        if not entry.opens:
            yield entry.name, entry.value, entry.location
    for name, setting in settings_of(sections.of_file(source, full), full).items():
        for item in sorted(setting.written, key=lambda item: item.won):
            yield name, item.value, item.location


def _values(
    sources: Sequence[ParameterSource],
    full: str | None,
    sections: Sections,
    overrides: Mapping[str, Setting],
) -> dict[str, ParameterValue]:
    """Return what counts; where there are nothing but values, without their places."""
    if not overrides and FileParameters not in map(type, sources):
        last = {source.name: source.value for source in sources if isinstance(source, InlineParameter)}
        return {name: value for name, value in last.items() if value is not None}
    found = _candidates(sources, full, sections, overrides)
    return {name: written[-1].value for name, written in found.items() if written[-1].value is not None}
