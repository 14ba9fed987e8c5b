"""`$(param name [default])`: a parameter that `set_parameter` put in scope."""

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
    """Return the parameter's value, else the default, which is evaluated only then.

    As upstream, parameters of a node and of parameter files are not looked at.
    """
    written = call.arguments[0]
    name = evaluate(written, context)
    if isinstance(name, Poison):
        return POISON
    value = context.parameters.get(name.text)
    if value is not None:
        return made(call, context, value)
    default = fallback(call, context, evaluate)
    if default is not None:
        return default
    told = f"no set_parameter has set {name.text!r} here"
    meant = nearest(name.text, context.parameters)
    return refuse(written, context, Code.UNDEFINED_VARIABLE, told, meant=meant)
