"""`include`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.nearest import nearest
from orchestra.resolve.context import POISON, Evaluated, Value
from orchestra.resolve.dependencies import dependency
from orchestra.resolve.paths import existing_file
from orchestra.resolve.repetition import repeated
from orchestra.resolve.resolution import Frame

if TYPE_CHECKING:
    from orchestra.description.actions.include import Include
    from orchestra.description.launch import Description
    from orchestra.description.parts import Pair
    from orchestra.location import Location
    from orchestra.resolve.resolution import Resolution
    from orchestra.resolve.scope import Ledger


def visit(action: Include, run: Resolution) -> None:
    """Visit the actions of another file: in this scope as upstream, in one of its own where that is asked for."""
    for _ in repeated(action.for_each, run):
        value = run.evaluate(action.file)
        path = existing_file(value, "launch file", run) if isinstance(value, Value) else None
        if path is None:
            run.found.incomplete = True
            continue
        if run.flag(action.scoped) is True:
            with run.scoped(run.scope.copy()):
                _include(action, path, run)
        else:
            _include(action, path, run)


def _include(action: Include, path: str, run: Resolution) -> None:
    location = run.at(action.span)
    given = _arguments(action, run)
    if _circles(path, location, run):
        return
    description = _description(path, location, run)
    if description is None:
        run.found.incomplete = True
        return
    run.found.incomplete |= description.incomplete
    frame = _frame(action, path, frozenset(given), run)
    before = dict(run.scope.variables)
    for name, (value, at) in given.items():
        run.scope.set(name, value, at)
    with run.inside(frame, location):
        run.visit(description.actions, run)
        ledger = run.scope.ledger
    _check_unread(action, ledger, description, run)
    run.scope.mark_leaks(before, action.span)


def _frame(action: Include, path: str, given: frozenset[str], run: Resolution) -> Frame:
    label = run.text(action.label)
    labels = run.frame.labels + ((label,) if isinstance(label, str) else ())
    edges = [dependency(item, run) for item in action.depends_on]
    depends_on = run.frame.depends_on + tuple(edge for edge in edges if edge is not None)
    return Frame(path, given, labels, depends_on)


def _arguments(action: Include, run: Resolution) -> dict[str, tuple[Evaluated, Location]]:
    """Evaluate the arguments in order: a later one sees nothing of an earlier one, as both are outside the file."""
    given: dict[str, tuple[Evaluated, Location]] = {}
    for pair in _pairs(action):
        name, value = run.evaluate(pair.name), run.evaluate(pair.value)
        if isinstance(name, Value):
            given[name.text] = (value or POISON, run.at(pair.value.span))
    return given


def _pairs(action: Include) -> tuple[Pair, ...]:
    return (*action.arg, *action.let)


def _description(path: str, location: Location, run: Resolution) -> Description | None:
    if path not in run.descriptions:
        chain = (location.span, *location.included_from)
        run.descriptions[path] = run.load(path, run.problems, chain)
    return run.descriptions[path]


def _circles(path: str, location: Location, run: Resolution) -> bool:
    """Report a file that includes itself, however far around."""
    if path not in (frame.path for frame in run.frames):
        return False
    run.found.incomplete = True
    run.problems.error(Code.INCLUDE_CYCLE, "the file includes itself", location)
    return True


def _check_unread(action: Include, ledger: Ledger, description: Description, run: Resolution) -> None:
    """Report arguments that the file neither declares nor reads."""
    for pair in _pairs(action):
        name = pair.name.constant
        if name is None or name in ledger.declared or name in ledger.read:
            continue
        meant = nearest(name, ledger.defaulted)
        if description.incomplete and meant is None:
            continue
        at = run.at(pair.name.span)
        message = f"{description.file} has no argument '{name}'"
        if meant is not None:
            run.problems.error(Code.UNKNOWN_ARGUMENT, message, at, suggestion=meant)
        else:
            run.problems.warning(Code.UNREAD_ARGUMENT, f"{message} and reads no variable of that name", at)
