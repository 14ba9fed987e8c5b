"""`let`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.location import is_python
from orchestra.resolve.context import Value
from orchestra.resolve.declarations import settle

if TYPE_CHECKING:
    from orchestra.description.actions.let import Let
    from orchestra.resolve.resolution import Resolution


def visit(action: Let, run: Resolution) -> None:
    """Set a variable."""
    name, value = run.evaluate(action.name), run.evaluate(action.value)
    if isinstance(name, Value) and value is not None:
        ledger, at = run.scope.ledger, name.location
        if name.text in ledger.declared and name.text not in ledger.read and not is_python(at):
            from orchestra.resolve.impossible.overwritten import check_overwritten  # noqa: PLC0415 - hardly ever

            check_overwritten(action, name, run)
        run.scope.set(name.text, value, run.place(action.value))
        settle(name.text, run.place(action), run)
        if name.verbatim and not is_python(at):
            run.found.lets.setdefault(name.text, at)
