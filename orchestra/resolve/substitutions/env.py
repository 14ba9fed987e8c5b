"""`$(env name [default])`: an environment variable, as the description has set it up to here."""

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
    """Return the environment variable's value, else the default, which is evaluated only then."""
    written = call.arguments[0]
    name = evaluate(written, context)
    if isinstance(name, Poison):
        return POISON
    value = context.environment.get(name.text)
    if value is not None:
        return made(call, context, value)
    default = fallback(call, context, evaluate)
    if default is not None:
        return default
    told = f"the environment variable {name.text!r} is not set"
    meant = nearest(name.text, context.environment)
    return refuse(written, context, Code.UNSET_ENVIRONMENT, told, meant=meant)
