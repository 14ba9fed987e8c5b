"""`node_container`: starts a process that components are loaded into."""

from __future__ import annotations

from pydantic import Field

from orchestra.description.actions.node import Node
from orchestra.description.components import ComposableNode
from orchestra.description.fields import Text


class NodeContainer(Node):
    """Start a component container and load components into it."""

    name: Text = Field(description="Name of the container's own node.")
    namespace: Text | None = Field(description="Namespace; a relative one is put below the pushed one.")
    composable_node: tuple[ComposableNode, ...] = Field(
        default=(), description="Components to load as soon as the container takes orders, in order."
    )
