"""`push_ros_namespace`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.context import Value, new_value
from orchestra.resolve.namespaces import below
from orchestra.resolve.scope import NAMESPACE

if TYPE_CHECKING:
    from orchestra.description.actions.push_ros_namespace import PushRosNamespace
    from orchestra.resolve.resolution import Resolution


def visit(action: PushRosNamespace, run: Resolution) -> None:
    """Put what follows below a namespace."""
    value, at = run.evaluate(action.namespace), run.place(action.namespace)
    pushed = below(run.scope.namespace(at), value, run.problems)
    if isinstance(pushed, Value):  # many nodes ask for its place
        pushed = new_value(pushed.text, at, through=pushed.through)
    if pushed is not None:
        run.scope.set(NAMESPACE, pushed, at, "push")
