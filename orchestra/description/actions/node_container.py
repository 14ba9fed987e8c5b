"""`node_container`: starts a process that components are loaded into."""

from __future__ import annotations

from typing import ClassVar

from orchestra.description.actions.node import Node
from orchestra.description.components import ComposableNode
from orchestra.description.fields import Text
from orchestra.description.model import field


class NodeContainer(Node):
    """Start a component container and load components into it."""

    exec: Text = field(description="Executable in the package; without `pkg` a program.")
    # A container is no program in Python: these keys are not its own.
    module: ClassVar[None] = None  # type: ignore[misc]
    script: ClassVar[None] = None  # type: ignore[misc]
    name: Text = field(description="Name of the container's own node.")
    namespace: Text | None = field(description="Namespace; a relative one is put below the pushed one.")
    composable_node: tuple[ComposableNode, ...] = field(
        default=(), description="Components to load as soon as the container takes orders, in order."
    )
