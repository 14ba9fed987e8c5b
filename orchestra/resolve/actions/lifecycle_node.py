"""`lifecycle_node`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.resolve.actions.node import start

if TYPE_CHECKING:
    from orchestra.description.actions.lifecycle_node import LifecycleNode
    from orchestra.resolve.resolution import Resolution


def visit(action: LifecycleNode, run: Resolution) -> None:
    """Start a node with a managed life cycle; its full name must be known, for its state is asked for by that."""
    index = start(action, "lifecycle_node", run, autostart=run.flag(action.autostart, default=False))
    process = run.found.processes[index]
    if process.namespace is None and not process.faulty:
        message = "a lifecycle node needs a full name: give it a namespace, which may be empty"
        run.problems.error(Code.BAD_NAME, message, process.location)
