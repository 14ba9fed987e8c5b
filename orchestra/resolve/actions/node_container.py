"""`node_container`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.resolve.actions.node import start
from orchestra.resolve.components import Container, add_components

if TYPE_CHECKING:
    from orchestra.description.actions.node_container import NodeContainer
    from orchestra.resolve.resolution import Resolution


def visit(action: NodeContainer, run: Resolution) -> None:
    """Start a container, and load its components as soon as it takes orders."""
    if action.lifecycle is not None:
        message = "the node of a container has no managed life cycle: give its components an `autostart`"
        run.problems.error(Code.CONFLICTING_KEYS, message, run.at(action.lifecycle.span))
    container = Container(process=start(action, "container", run))
    add_components(action.composable_node, container, run, delayed=False)
