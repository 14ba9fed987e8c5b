"""The third stage: what was resolved becomes a plan, checked for what can never work."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, NamedTuple

from orchestra.fields import replace
from orchestra.plan.awaited import life, readiness
from orchestra.plan.checks.table import check_all
from orchestra.plan.command import command
from orchestra.plan.components import components
from orchestra.plan.digest import digest_of
from orchestra.plan.edges import Targets, check_cycles, dependencies
from orchestra.plan.ids import check_names, identities
from orchestra.plan.model import (
    VERSION,
    Argument,
    ParameterFile,
    Plan,
    Process,
    Provenance,
    Skipped,
    late_provenance,
    new_file,
    new_process,
)
from orchestra.plan.parameter_file import path_of
from orchestra.plan.parameters import check_given, parameters_of
from orchestra.plan.passed_on import Sections
from orchestra.plan.provenance import environment_of, provenance
from orchestra.plan.remappings import check_remaps
from orchestra.plan.terminal import check_stdin
from orchestra.plan.triggers import triggers
from orchestra.plan.warm import wish

if TYPE_CHECKING:
    from collections.abc import Collection

    from orchestra.errors import Problems
    from orchestra.plan.conditions import Dependency
    from orchestra.plan.parameters import Parameters
    from orchestra.plan.warm import Warmth
    from orchestra.resolve.model import Resolved, ResolvedComponent, ResolvedProcess
    from orchestra.values import ParameterValue


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
    ids = identities(resolved.processes)
    loaded = identities(resolved.components, ids)
    nodes: list[ResolvedProcess | ResolvedComponent] = [*resolved.processes, *resolved.components]
    new = [node for identity, node in zip((*ids, *loaded), nodes, strict=True) if identity not in known]
    check_names(new, problems, resolved.processes)
    targets = Targets(resolved, ids)
    edges = {
        identity: dependencies(process, identity, targets, problems)
        for identity, process in targets.process.items()
    }
    check_cycles(edges, problems)
    check_stdin(targets.process, problems)
    check_given(resolved, problems)
    sections = Sections(resolved, frozenset(targets.full))
    common = _Common(sections, problems, whole, warmth)
    named = zip(targets.process.items(), targets.full, strict=True)
    processes = [_process(process, key, full, edges[key], common) for (key, process), full in named]
    plan = Plan(
        VERSION,
        resolved.file,
        _arguments(resolved) if whole else (),
        tuple(processes),
        components(resolved, ids, loaded, sections, problems),
        triggers(resolved, ids, loaded, triggers_before),
        tuple(
            Skipped(item.action, item.name, item.condition, item.expression, item.value, item.location)
            for item in resolved.skipped
        ),
        (),
    )
    check_all(resolved, plan, problems)
    return replace(plan, problems=problems.ordered) if whole else plan


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
    parameters = parameters_of(process, full, sections, problems, whole=whole)
    check_remaps(process, problems)
    path = path_of(identity) if parameters.is_passed and (parameters.values or parameters.files) else None
    files = tuple([new_file(path or file.path, file.content) for file in parameters.files])
    words, environment = command(process, path) if whole else (), environment_of(process)
    wished = None if process.warm is None else wish(process.warm)
    return new_process(
        id=identity,
        kind=process.kind,
        package=process.package,
        executable=process.executable,
        name=process.name.text if process.name is not None else None,
        namespace=process.namespace.text if process.namespace is not None else None,
        command=words,
        shell=process.shell,
        prefix=process.prefix,
        environment=environment,
        inherit_environment=process.inherit_environment,
        cwd=process.cwd,
        parameters=parameters.values,
        parameter_files=files,
        remappings=tuple([(rule.source.text, rule.target.text) for rule in process.remaps]),
        arguments=process.arguments,
        output=process.output,
        emulate_tty=process.emulate_tty,
        stdin=None if process.stdin is None else True,
        restart=process.restart,
        required=process.required,
        success_exit_codes=process.success_exit_codes,
        ready=None if process.ready is None else readiness(process, problems),
        alive=None if process.alive is None else life(process, problems),
        lifecycle="active" if process.autostart else None,
        depends_on=edges,
        stop=process.stop,
        limits=process.limits,
        warm=wished if warmth is None else warmth.of(process, wished, words, environment),
        machine=None,
        digest=_digest(process, words, environment, parameters.values, files) if whole else "",
        location=process.location,
        provenance=late_provenance(partial(_provenance, process, parameters, whole=whole)),
        params_schema=None if process.params_schema is None else process.params_schema.text,
    )


def _provenance(process: ResolvedProcess, parameters: Parameters, *, whole: bool) -> Provenance:
    return provenance(process, parameters) if whole else Provenance(parameters=parameters.written())


def _digest(
    process: ResolvedProcess,
    words: tuple[str, ...],
    environment: dict[str, str | None],
    values: dict[str, ParameterValue],
    files: tuple[ParameterFile, ...],
) -> str:
    around = (environment, process.inherit_environment)
    how = (None if process.stdin is None else True, process.shell, process.limits)
    # As the encoder of plans has them.
    given = [{"path": file.path, "content": file.content} for file in files]
    return digest_of(words, around, process.cwd, values, given, *how)
