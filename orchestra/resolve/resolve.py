"""The second stage: a description and what the caller gave come to processes, triggers and arguments."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.location import Location
from orchestra.resolve.arguments import Given, settle
from orchestra.resolve.context import CommandRunner, Context, Packages, Value
from orchestra.resolve.given import given_sections
from orchestra.resolve.interpret import visit, visit_file
from orchestra.resolve.model import Resolved
from orchestra.resolve.resolution import Found, Frame, LoadFile, Resolution
from orchestra.resolve.scope import Ledger, Scope

if TYPE_CHECKING:
    from orchestra.description.launch import Description
    from orchestra.errors import Problems
    from orchestra.resolve.inputs import Inputs


def resolve(
    description: Description,
    inputs: Inputs,
    problems: Problems,
    *,
    load: LoadFile,
    packages: Packages,
    run_command: CommandRunner,
) -> Resolved:
    """Visit a description depth-first. What is wrong is reported; what is faulty is left out or marked."""
    scope = Scope(problems, Ledger(), dict(inputs.environment))
    for given in inputs.arguments:
        location = Location(given.span)
        scope.set(given.name, Value(given.value, location), location)
    run = _begin(description, inputs, problems, scope, load, packages, run_command)
    with run.inside(Frame(description.path, scope)) as ledger:
        visit_file(description, run)
        names = [Given(item.name, Location(item.span)) for item in inputs.arguments]
        settle(names, description, ledger, run)
    return Resolved(
        description.file,
        tuple(run.found.arguments.values()),
        tuple(run.found.processes),
        tuple(run.found.triggers),
        tuple(run.found.skipped),
        given_sections(run),
        frozenset(run.found.lost),
        scope.ledger.incomplete,
    )


def _begin(
    description: Description,
    inputs: Inputs,
    problems: Problems,
    scope: Scope,
    load: LoadFile,
    packages: Packages,
    run_command: CommandRunner,
) -> Resolution:
    found = Found()
    context = Context(
        problems,
        scope,
        scope.environment,
        packages,
        run_command,
        launching=inputs.launching,
        parameters=scope.parameter_texts,
        lost=found.lost,
    )
    run = Resolution(inputs, problems, load, visit, context, scope, found)
    run.descriptions[description.path] = description
    return run
