"""`set_parameter`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.description.text import span_of
from orchestra.resolve.context import Poison
from orchestra.resolve.model import InlineParameter
from orchestra.resolve.parameters import typed

if TYPE_CHECKING:
    from orchestra.description.actions.set_parameter import SetParameter
    from orchestra.resolve.resolution import Resolution


def visit(action: SetParameter, run: Resolution) -> None:
    """Set a parameter of every node that follows."""
    name, value = run.text(action.name), typed(action.value, None, run)
    if isinstance(name, str) and isinstance(value, Poison):
        run.found.lost.add(name)
    if not isinstance(name, str) or isinstance(value, Poison):
        return
    at = run.at(span_of(action.value) or action.span)
    parameter = InlineParameter(name, value, at, everywhere=True)
    run.scope.set_parameter(parameter)
