"""Where the values of a process were written."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.plan.model import Candidate, Provenance

if TYPE_CHECKING:
    from orchestra.plan.parameters import Parameters
    from orchestra.resolve.model import ResolvedProcess


def environment_of(process: ResolvedProcess) -> dict[str, str | None]:
    """Return the variables that the description sets, or removes (None); the last change counts."""
    return {name: changes[-1].value for name, changes in process.environment.items()}


def provenance(process: ResolvedProcess, parameters: Parameters) -> Provenance:
    """Return the places of all that can be overruled."""
    return Provenance(
        name=process.name.location if process.name is not None else None,
        namespace=process.namespace.location if process.namespace is not None else None,
        parameters=parameters.candidates,
        remappings=tuple(rule.source.location for rule in process.remaps),
        environment={
            name: tuple(
                Candidate(change.value, change.location, change is changes[-1], "the last one counts")
                for change in changes
            )
            for name, changes in process.environment.items()
        },
    )
