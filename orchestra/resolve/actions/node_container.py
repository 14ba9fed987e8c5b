"""`node_container`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.actions.node import start
from orchestra.resolve.components import Container, add_components

if TYPE_CHECKING:
    from orchestra.description.actions.node_container import NodeContainer
    from orchestra.resolve.resolution import Resolution


def visit(action: NodeContainer, run: Resolution) -> None:
    """Start a container, and load its components as soon as it takes orders."""
    container = Container(process=start(action, "container", run))
    add_components(action.composable_node, container, run, delayed=False)
