"""The second stage: a description and what the caller gave come to processes, triggers and arguments."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.errors import Code
from orchestra.location import Location
from orchestra.resolve.arguments import Given, settle
from orchestra.resolve.containers import settle_containers
from orchestra.resolve.context import CommandRunner, Context, Packages, Value
from orchestra.resolve.found import Found
from orchestra.resolve.interpret import visit, visit_file
from orchestra.resolve.ledger import Ledger
from orchestra.resolve.model import GivenSections, Resolved
from orchestra.resolve.resolution import Frame, LoadFile, Resolution
from orchestra.resolve.scope import Scope
from orchestra.resolve.settling import settled
from orchestra.resolve.unpackaged import warn_of_unpackaged
from orchestra.witness.variables import copied

if TYPE_CHECKING:
    from orchestra.description.launch import Description
    from orchestra.description.text import Opaque
    from orchestra.errors import Problems
    from orchestra.resolve.context import Evaluated
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
    run = begin(inputs, problems, load=load, packages=packages, run_command=run_command)
    return carry_through(description, run)


def carry_through(description: Description, run: Resolution) -> Resolved:
    """Visit a description in a resolution that has just begun."""
    run.descriptions[description.path] = description
    for given in run.inputs.arguments:
        value = Value(given.value, Location(given.value_span), verbatim=True)
        run.scope.set(given.name, value, Location(given.span), "command line")
    with run.inside(Frame(description.path, run.scope)) as ledger:
        try:
            visit_file(description, run)
            run.handle_events()
        except RecursionError as error:
            run.report_endless(error)
        names = [Given(item.name, Location(item.span)) for item in run.inputs.arguments]
        settle(names, description, ledger, run)
        if run.found.lets:
            # Here, because few launch files have any.
            from orchestra.resolve.idle_lets import warn_of_idle_lets  # noqa: PLC0415

            warn_of_idle_lets(ledger, run)
    _tell_doubts(run)
    if any(problem.code is Code.UNDEFINED_VARIABLE for problem in run.problems):
        from orchestra.resolve.set_elsewhere import tell_where_set  # noqa: PLC0415 - only where something is wrong

        tell_where_set(run)
    warn_of_unpackaged(run)
    if run.found.spawned:
        from orchestra.resolve.spawners import warn_of_spawned  # noqa: PLC0415 - as above

        warn_of_spawned(run)
    return outcome(description.file, run)


def _tell_doubts(run: Resolution) -> None:
    """Tell what is wrong with actions that were left out, where they always were and nothing is told in that place."""
    told = {problem.span for problem in run.problems}
    for action, found in run.found.doubts:
        if id(action) not in run.found.visited:
            run.problems.extend(problem for problem in found if problem.span not in told)


def outcome(file: str, run: Resolution) -> Resolved:
    """Return what has been found so far; triggers only those since the last time."""
    settle_containers(run)
    return Resolved(
        file,
        tuple(run.found.arguments.values()),
        tuple(run.found.processes),
        settled(run),
        tuple(run.found.skipped),
        _given(run),
        frozenset(run.found.lost),
        run.scope.ledger.incomplete,
        tuple(run.found.components),
    )


def _given(run: Resolution) -> tuple[GivenSections, ...]:
    if not run.inputs.parameter_files and not run.inputs.parameters:
        return ()
    from orchestra.resolve.given import given_sections  # noqa: PLC0415 - few command lines say something of parameters

    return given_sections(run)


def begin(
    inputs: Inputs,
    problems: Problems,
    *,
    load: LoadFile,
    packages: Packages,
    run_command: CommandRunner,
) -> Resolution:
    """Return the state with which a resolution begins: nothing set, nothing found, in no file."""
    scope = Scope(problems, Ledger(), copied(inputs.environment))
    found = Found()
    context = Context(
        problems,
        scope,
        scope.environment,
        packages,
        run_command,
        launching=inputs.launching,
        inputs=inputs,
        parameters=scope.parameter_texts,
        lost=found.lost,
    )
    run = Resolution(inputs, problems, load, visit, context, scope, found, make_engine=_engine)
    context.perform_opaque = lambda part: _performed(part, run)
    return run


def _performed(part: Opaque, run: Resolution) -> Evaluated:
    # Here, because only Python launch files have such parts.
    from orchestra.resolve.python.performing import perform_opaque  # noqa: PLC0415

    return perform_opaque(part, run)


def end(run: Resolution) -> None:
    """Undo that a resolution and its context hold each other: what they have goes at once when nobody needs them."""
    del run.context.perform_opaque


def _engine(run: Resolution) -> Any:  # noqa: ANN401 - a ResolvingEngine
    # Here, because only Python launch files need it and what it imports.
    from orchestra.resolve.python.engine import ResolvingEngine  # noqa: PLC0415

    return ResolvingEngine(run, [f"{item.name}:={item.value}" for item in run.inputs.arguments])
