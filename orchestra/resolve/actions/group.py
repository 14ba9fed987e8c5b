"""`group`."""

from __future__ import annotations

from contextlib import nullcontext
from typing import TYPE_CHECKING

from orchestra.resolve.impossible.late_settings import SETTINGS, check_alone, check_late
from orchestra.resolve.kept import Apart, kept
from orchestra.resolve.repetition import repeated
from orchestra.witness.variables import copied

if TYPE_CHECKING:
    from contextlib import AbstractContextManager

    from orchestra.description.actions.group import Group
    from orchestra.resolve.resolution import Resolution


def visit(action: Group, run: Resolution) -> None:
    """Visit the children, in a scope of their own unless `scoped` is false."""
    for _ in repeated(action.for_each, run):
        keep = kept(action.keep, run)
        with _scope(action, run):
            for name, value, location in keep:
                run.scope.set(name, value, location)
            run.visit(action.children, run)


def _scope(action: Group, run: Resolution) -> AbstractContextManager[None]:
    if run.flag(action.scoped, default=True) is False:
        return nullcontext()
    check_late(action.children, run)
    if action.children and type(action.children[-1]).__name__ in SETTINGS:
        check_alone(action.children, run)
    if run.flag(action.forwarding, default=True) is False:
        environment = copied(run.inputs.environment)
        return run.scoped(Apart(run.problems, run.scope.ledger, environment, outside=run.scope.names()))
    return run.scope.nested()
