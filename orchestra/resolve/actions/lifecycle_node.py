"""`lifecycle_node`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.actions.node import start

if TYPE_CHECKING:
    from orchestra.description.actions.lifecycle_node import LifecycleNode
    from orchestra.resolve.resolution import Resolution


def visit(action: LifecycleNode, run: Resolution) -> None:
    """Start a node with a managed life cycle."""
    start(action, "lifecycle_node", run, autostart=run.flag(action.autostart, default=False))
