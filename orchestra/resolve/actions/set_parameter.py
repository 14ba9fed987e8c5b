"""`set_parameter`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.parameters import everywhere

if TYPE_CHECKING:
    from orchestra.description.actions.set_parameter import SetParameter
    from orchestra.resolve.resolution import Resolution


def visit(action: SetParameter, run: Resolution) -> None:
    """Set a parameter of every node that follows."""
    found = everywhere(action, run)
    if None in found and isinstance(name := run.text(action.name), str):
        run.found.lost.add(name)
    for parameter in found:
        if parameter is not None:
            run.scope.set_parameter(parameter)
