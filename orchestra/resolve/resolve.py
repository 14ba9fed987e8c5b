"""The second stage: a description and what the caller gave come to processes, triggers and arguments."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code, Problems
from orchestra.location import Location
from orchestra.nearest import nearest
from orchestra.resolve.context import CommandRunner, Context, Packages, Value
from orchestra.resolve.given import given_sections
from orchestra.resolve.interpret import visit
from orchestra.resolve.model import Resolved
from orchestra.resolve.resolution import Frame, LoadFile, Resolution
from orchestra.resolve.scope import Ledger, Scope

if TYPE_CHECKING:
    from orchestra.description.launch import Description
    from orchestra.resolve.inputs import Inputs

# Variables that upstream itself gives a meaning, so that they need no declaration.
_KNOWN = frozenset(
    {"launch-prefix", "launch-prefix-filter", "emulate_tty", "sigterm_timeout", "sigkill_timeout"}
)


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
    context = Context(
        problems,
        scope,
        scope.environment,
        packages,
        run_command,
        description.path,
        launching=inputs.launching,
    )
    run = Resolution(inputs, problems, load, visit, context, scope, frames=(Frame(description.path),))
    run.descriptions[description.path] = description
    run.found.incomplete = description.incomplete
    visit(description.actions, run)
    _check_given_arguments(run)
    return Resolved(
        description.file,
        tuple(run.found.arguments.values()),
        tuple(run.found.processes),
        tuple(run.found.triggers),
        tuple(run.found.skipped),
        given_sections(run),
        run.found.incomplete,
    )


def _check_given_arguments(run: Resolution) -> None:
    """Report launch arguments of the command line that nothing declares or reads."""
    ledger = run.scope.ledger
    for given in run.inputs.arguments:
        if given.name in ledger.declared | ledger.read | _KNOWN:
            continue
        message = f"there is no launch argument '{given.name}'"
        suggestion = nearest(given.name, ledger.declared)
        if run.found.hidden_include or (run.found.incomplete and suggestion is None):
            message += " in what was read; a part was left out"
            run.problems.warning(Code.UNREAD_ARGUMENT, message, given.span, suggestion=suggestion)
        else:
            run.problems.error(Code.UNKNOWN_ARGUMENT, message, given.span, suggestion=suggestion)
