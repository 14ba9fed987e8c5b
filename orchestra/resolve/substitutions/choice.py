"""`$(if condition value [else])`: one of two values."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.context import POISON, Poison
from orchestra.resolve.substitutions.arguments import boolean_argument, made

if TYPE_CHECKING:
    from orchestra.description.text import Call
    from orchestra.resolve.context import Context, Evaluated
    from orchestra.resolve.substitutions.arguments import Evaluate


def perform(call: Call, context: Context, evaluate: Evaluate) -> Evaluated:
    """Return the chosen value, the only one that is evaluated; without an else it may be empty."""
    condition, *values = call.arguments
    flag = boolean_argument(condition, context, evaluate)
    if flag is None:
        return POISON
    chosen = values[:1] if flag else values[1:]
    if not chosen:
        return made(call, context, "")
    value = evaluate(chosen[0], context)
    return POISON if isinstance(value, Poison) else made(call, context, value.text)
