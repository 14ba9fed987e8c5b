"""`group`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.context import Value
from orchestra.resolve.repetition import repeated
from orchestra.resolve.scope import Scope

if TYPE_CHECKING:
    from orchestra.description.actions.group import Group
    from orchestra.resolve.resolution import Resolution


def visit(action: Group, run: Resolution) -> None:
    """Visit the children, in a scope of their own unless `scoped` is false."""
    for _ in repeated(action.for_each, run):
        if run.flag(action.scoped, default=True) is False:
            _keep(action, run, run.scope)
            run.visit(action.children, run)
            continue
        forwarding = run.flag(action.forwarding, default=True) is not False
        scope = run.scope.copy() if forwarding else _fresh(run)
        _keep(action, run, scope)
        with run.scoped(scope):
            run.visit(action.children, run)


def _fresh(run: Resolution) -> Scope:
    """Return a scope in which nothing is set, with the environment that the launch began with."""
    return Scope(run.problems, run.scope.ledger, dict(run.inputs.environment))


def _keep(action: Group, run: Resolution, scope: Scope) -> None:
    """Set the variables of `keep`; they are evaluated outside."""
    kept = [
        (run.evaluate(pair.name), run.evaluate(pair.value), run.at(pair.value.span)) for pair in action.keep
    ]
    for name, value, location in kept:
        if isinstance(name, Value) and value is not None:
            scope.set(name.text, value, location)
