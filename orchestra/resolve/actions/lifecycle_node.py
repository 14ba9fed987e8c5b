"""`lifecycle_node`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.description.actions.node import REACHED
from orchestra.errors import Code
from orchestra.resolve.actions.node import start
from orchestra.resolve.context import POISON, Poison

if TYPE_CHECKING:
    from orchestra.description.actions.lifecycle_node import LifecycleNode
    from orchestra.resolve.resolution import Resolution


def visit(action: LifecycleNode, run: Resolution) -> None:
    """Start a node with a managed life cycle; its full name must be known, for its state is asked for by that."""
    index = start(action, "lifecycle_node", run, autostart=_autostart(action, run))
    process = run.found.processes[index]
    if process.namespace is None and not process.faulty:
        message = "a lifecycle node needs a full name: give it a namespace, which may be empty"
        run.problems.error(Code.BAD_NAME, message, process.location)


def _autostart(action: LifecycleNode, run: Resolution) -> bool | Poison | None:
    """Return whether it is brought to its active state, as upstream's key or the one of all nodes says."""
    if action.lifecycle is None:
        return run.flag(action.autostart, default=False)
    if action.autostart is not None:
        message = "`autostart` and `lifecycle` say the same thing twice: leave one of them out"
        notes = (f"`lifecycle` is at {run.at(action.lifecycle.span)}",)
        run.problems.error(Code.CONFLICTING_KEYS, message, run.at(action.autostart.span), notes=notes)
        return POISON
    managed = run.word(action.lifecycle, REACHED)
    return managed if isinstance(managed, Poison) else managed is not None
