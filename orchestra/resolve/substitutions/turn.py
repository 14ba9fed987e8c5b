"""`$(index name)` and `$(for-var name [default])`: a value of the turn of a loop that is going on."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.nearest import nearest
from orchestra.resolve.context import POISON
from orchestra.resolve.refusals import refuse
from orchestra.resolve.substitutions.lookup import looked_up

if TYPE_CHECKING:
    from orchestra.description.text import Call, Template
    from orchestra.resolve.context import Context, Evaluated, Poison
    from orchestra.resolve.substitutions.arguments import Evaluate


# No variable of a launch file has a blank in its name.
_UNKNOWN = "for-var "  # the variable that is set where nobody knows which values a turn has


def local_of(name: str) -> str:
    """Return the variable that holds a value of the turn."""
    return f"{_UNKNOWN}{name}"


def perform(call: Call, context: Context, evaluate: Evaluate) -> Evaluated:
    """Return the value, else the default, which is evaluated only then."""
    at = context.at(call.span)
    if _UNKNOWN in context.variables.names():
        return POISON
    return looked_up(
        call,
        context,
        evaluate,
        find=lambda name: context.variables.get(local_of(name), at),
        report=_report,
    )


def _report(name: str, written: Template, context: Context) -> Poison:
    held = [
        variable.removeprefix(_UNKNOWN)
        for variable in context.variables.names()
        if variable.startswith(_UNKNOWN)
    ]
    told = f"the loop has no {name!r}" if held else f"there is no loop around this that has a {name!r}"
    return refuse(written, context, Code.UNDEFINED_VARIABLE, told, meant=nearest(name, held))
