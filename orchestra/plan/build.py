"""The third stage: what was resolved becomes a plan, checked for what can never work."""

from __future__ import annotations

from functools import partial
from operator import attrgetter
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from orchestra.fields import replace
from orchestra.plan.awaited import life, readiness
from orchestra.plan.checks.table import check_all
from orchestra.plan.command import command
from orchestra.plan.components import components
from orchestra.plan.digest import digest
from orchestra.plan.edges import Targets, check_cycles, dependencies
from orchestra.plan.ids import check_names, full_names, identities, node_name
from orchestra.plan.model import (
    VERSION,
    Argument,
    Plan,
    Process,
    Provenance,
    Skipped,
    new_file,
    new_process,
)
from orchestra.plan.parameter_file import path_of
from orchestra.plan.parameters import check_given, parameters_of
from orchestra.plan.passed_on import Sections
from orchestra.plan.provenance import environment_of, provenance
from orchestra.plan.remappings import remappings
from orchestra.plan.terminal import check_stdin
from orchestra.plan.triggers import triggers
from orchestra.plan.warm import wish

if TYPE_CHECKING:
    from collections.abc import Collection

    from orchestra.errors import Problems
    from orchestra.plan.conditions import Dependency
    from orchestra.plan.parameters import Parameters
    from orchestra.plan.warm import Warmth
    from orchestra.resolve.model import Resolved, ResolvedProcess

_DEPENDS_ON: Final = attrgetter("depends_on")
# It is made of a process when somebody asks for it.
_DIGEST: Final[Any] = digest


def build(
    resolved: Resolved,
    problems: Problems,
    *,
    triggers_before: int = 0,
    known: Collection[str] = (),
    whole: bool = True,
    warmth: Warmth | None = None,
) -> Plan:
    """Return the plan. What cannot work is reported; the problems found so far become part of the plan.

    `triggers_before` counts the triggers of a plan that is added to, and `known` are the ids in it. A node that is
    added may have the name of one of these: most often it replaces one that has ended. A plan that is not `whole` has
    what the checks look at, and is for nobody else: its processes cannot be started, compared or explained. Without
    `warmth` it is left open which processes can be forked (`warmed`).
    """
    full, named = full_names(resolved.processes), list(map(node_name, resolved.components))
    ids = identities(resolved.processes, full)
    loaded = identities(resolved.components, named, ids)
    every = (*ids, *loaded)
    new = [place for place, identity in enumerate(every) if identity not in known] if known else None
    check_names(resolved, (*full, *named), new, problems)
    targets = Targets(resolved, ids, full)
    edges = _edges(targets, problems) if any(map(_DEPENDS_ON, resolved.processes)) else {}
    check_stdin(targets.process, problems)
    check_given(resolved, problems)
    sections = Sections(resolved, frozenset(full))
    common = _Common(sections, problems, whole, warmth)
    processes = [
        _process(process, key, name, edges.get(key, ()), common)
        for key, process, name in zip(ids, resolved.processes, full, strict=True)
    ]
    plan = Plan(
        VERSION,
        resolved.file,
        _arguments(resolved) if whole else (),
        tuple(processes),
        components(resolved, ids, loaded, sections, problems),
        triggers(resolved, ids, loaded, triggers_before),
        _skipped(resolved),
        (),
    )
    check_all(resolved, plan, problems)
    return replace(plan, problems=problems.ordered) if whole else plan


def _edges(targets: Targets, problems: Problems) -> dict[str, tuple[Dependency, ...]]:
    """Return what each process waits for, by its id. Circles are reported."""
    edges = {
        identity: dependencies(process, identity, targets, problems) if process.depends_on else ()
        for identity, process in targets.process.items()
    }
    check_cycles(edges, problems)
    return edges


def _skipped(resolved: Resolved) -> tuple[Skipped, ...]:
    return tuple(
        Skipped(item.action, item.name, item.condition, item.expression, item.value, item.location)
        for item in resolved.skipped
    )


def _arguments(resolved: Resolved) -> tuple[Argument, ...]:
    return tuple(
        Argument(
            item.name,
            item.default,
            item.value,
            item.description,
            item.choices,
            item.location,
            item.given,
        )
        for item in resolved.arguments
    )


class _Common(NamedTuple):
    """What all processes of a plan have in common."""

    sections: Sections
    problems: Problems
    whole: bool
    warmth: Warmth | None


def _process(
    process: ResolvedProcess, identity: str, full: str | None, edges: tuple[Dependency, ...], common: _Common
) -> Process:
    sections, problems, whole, warmth = common
    name, namespace = process.name, process.namespace
    wished = None if process.warm is None else wish(process.warm)
    parameters = parameters_of(process, full, sections, problems, whole=whole)
    values, passed = parameters.values, parameters.passed
    path = path_of(identity) if parameters.is_passed and (values or passed is not None) else None
    rules = remappings(process, problems) if process.remaps else ()
    words = command(process, path, rules) if whole else ()
    environment = environment_of(process) if process.environment else {}
    return new_process(  # by position, in which so many arguments take a third of the time that names take
        identity,
        process.kind,
        process.package,
        process.executable,
        None if name is None else name.text,
        None if namespace is None else namespace.text,
        words,
        process.shell,
        process.prefix,
        environment,
        process.inherit_environment,
        process.cwd,
        values,
        () if passed is None or path is None else (new_file(path, passed),),
        rules,
        process.arguments,
        process.output,
        process.emulate_tty,
        None if process.stdin is None else True,
        process.restart,
        process.required,
        process.success_exit_codes,
        None if process.ready is None else readiness(process, problems),
        None if process.alive is None else life(process, problems),
        "active" if process.autostart else None,
        edges,
        process.stop,
        process.limits,
        wished if warmth is None else warmth.of(process, wished, words, environment),
        None,  # machine
        _DIGEST if whole else "",
        process.location,
        partial(_provenance, process, parameters, whole),  # type: ignore[arg-type]  # made when asked for
        None if process.params_schema is None else process.params_schema.text,
    )


def _provenance(process: ResolvedProcess, parameters: Parameters, whole: bool, _: Process) -> Provenance:
    return provenance(process, parameters) if whole else Provenance(parameters=parameters.written())
