"""`$(var name [default])`: a launch argument or variable."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.nearest import nearest
from orchestra.resolve.context import POISON, Poison
from orchestra.resolve.refusals import refuse
from orchestra.resolve.substitutions.arguments import fallback, made

if TYPE_CHECKING:
    from orchestra.description.text import Call
    from orchestra.resolve.context import Context, Evaluated
    from orchestra.resolve.substitutions.arguments import Evaluate


def perform(call: Call, context: Context, evaluate: Evaluate) -> Evaluated:
    """Return the variable's value, else the default, which is evaluated only then."""
    written = call.arguments[0]
    name = evaluate(written, context)
    if isinstance(name, Poison):
        return POISON
    value = context.variables.get(name.text, context.at(call.span))
    if value is not None:
        return POISON if isinstance(value, Poison) else made(call, context, value.text)
    default = fallback(call, context, evaluate)
    if default is not None:
        return default
    told = f"no launch argument or variable {name.text!r} is set here"
    meant = nearest(name.text, context.variables.names())
    return refuse(written, context, Code.UNDEFINED_VARIABLE, told, meant=meant)
