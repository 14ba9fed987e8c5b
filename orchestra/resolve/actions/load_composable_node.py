"""`load_composable_node`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.resolve.components import Container, add_components
from orchestra.resolve.context import Value
from orchestra.resolve.names import Fault, rmw_namespace_fault

if TYPE_CHECKING:
    from orchestra.description.actions.load_composable_node import LoadComposableNode
    from orchestra.resolve.resolution import Resolution


def visit(action: LoadComposableNode, run: Resolution) -> None:
    """Load components into a container: with its start, or when the timer around them goes off."""
    add_components(action.composable_node, _container(action, run), run, delayed=run.occasion is not None)


def _container(action: LoadComposableNode, run: Resolution) -> Container:
    """Return the container; a name without a slash in front is one in the root (launch_ros asks from there)."""
    if action.target.action is not None:
        return Container(None, origin=action.target.action)
    name = run.evaluate(action.target)
    if not isinstance(name, Value):
        return Container(None, faulty=True)
    full = "/" + name.text.removeprefix("/")
    fault = rmw_namespace_fault(full) if full != "/" else Fault("it must not be empty", 0)
    if fault is None:
        return Container(Value(full, name.location))
    message = f"'{name.text}' cannot be the full name of a container: {fault.reason}"
    run.problems.error(Code.BAD_NAME, message, name.location)
    return Container(None, faulty=True)
