"""`load_composable_node`: loads components into a container that runs already."""

from __future__ import annotations

from orchestra.description.components import ComposableNode
from orchestra.description.entity import Action
from orchestra.description.fields import Text
from orchestra.description.model import field


class LoadComposableNode(Action):
    """Load components into a container of this launch, or of another one.

    Where Python names the container by the action that starts it, `target` is an `Opaque` of that action.
    """

    target: Text = field(description="Full name of the container's node.")
    composable_node: tuple[ComposableNode, ...] = field(description="The components, in order.")
