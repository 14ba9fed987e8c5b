"""Where the values of a process were written."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.plan import candidates
from orchestra.plan.model import Provenance

if TYPE_CHECKING:
    from orchestra.plan.model import Candidate, Via
    from orchestra.plan.parameters import Parameters
    from orchestra.resolve.model import ResolvedComponent, ResolvedProcess


def environment_of(process: ResolvedProcess) -> dict[str, str | None]:
    """Return the variables that the description sets, or removes (None); the last change counts."""
    return {name: changes[-1].value for name, changes in process.environment.items()}


def provenance(process: ResolvedProcess, parameters: Parameters) -> Provenance:
    """Return the places of all that can be overruled."""
    return Provenance(
        name=process.name.location if process.name is not None else None,
        namespace=process.namespace.location if process.namespace is not None else None,
        parameters=parameters.written(),
        remappings=tuple(rule.source.location for rule in process.remaps),
        environment={
            name: candidates.of_environment(changes) for name, changes in process.environment.items()
        },
        naming=naming(process),
        remapping_values=remapping_values(process),
        command=candidates.passage(process.through),
        params_schema=None if process.params_schema is None else process.params_schema.location,
    )


def naming(node: ResolvedProcess | ResolvedComponent) -> dict[str, tuple[Candidate, ...]]:
    """Return all that was written for the name and the namespace of a node, under these two words."""
    found = {"name": candidates.of_name(node.name), "namespace": candidates.of_namespace(node.namespace)}
    return {word: written for word, written in found.items() if written}


def remapping_values(node: ResolvedProcess | ResolvedComponent) -> tuple[tuple[Via, ...], ...]:
    """Return for each remapping rule what its two sides came through."""
    return tuple(candidates.passage([*rule.source.through, *rule.target.through]) for rule in node.remaps)
