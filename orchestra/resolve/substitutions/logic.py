"""`$(not value)`, `$(and left right)`, `$(or left right)`, `$(any value...)` and `$(all value...)`.

Upstream evaluates every argument and cannot parse the last two.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.context import POISON
from orchestra.resolve.substitutions.arguments import booleans, made, truth

if TYPE_CHECKING:
    from orchestra.description.text import Call
    from orchestra.resolve.context import Context, Evaluated
    from orchestra.resolve.substitutions.arguments import Evaluate


def negation(call: Call, context: Context, evaluate: Evaluate) -> Evaluated:
    """Return true where the value is false."""
    flags = booleans(call, context, evaluate)
    return POISON if flags is None else made(call, context, truth(not flags[0]))


def conjunction(call: Call, context: Context, evaluate: Evaluate) -> Evaluated:
    """Return true where every value is true; there may be none."""
    flags = booleans(call, context, evaluate)
    return POISON if flags is None else made(call, context, truth(all(flags)))


def disjunction(call: Call, context: Context, evaluate: Evaluate) -> Evaluated:
    """Return true where at least one value is true."""
    flags = booleans(call, context, evaluate)
    return POISON if flags is None else made(call, context, truth(any(flags)))
