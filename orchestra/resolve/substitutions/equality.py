"""`$(equals left right)` and `$(not-equals left right)`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

from orchestra.resolve.context import POISON
from orchestra.resolve.substitutions.arguments import made, texts, truth

if TYPE_CHECKING:
    from orchestra.description.text import Call
    from orchestra.resolve.context import Context, Evaluated
    from orchestra.resolve.substitutions.arguments import Evaluate

_BOOLEANS: Final = {"true": True, "1": True, "false": False, "0": False}


def equals(call: Call, context: Context, evaluate: Evaluate) -> Evaluated:
    """Return true where both texts are equal."""
    words = texts(call, context, evaluate)
    return POISON if words is None else made(call, context, truth(equal(*words)))


def not_equals(call: Call, context: Context, evaluate: Evaluate) -> Evaluated:
    """Return true where the texts differ."""
    words = texts(call, context, evaluate)
    return POISON if words is None else made(call, context, truth(not equal(*words)))


def equal(left: str, right: str) -> bool:
    """Compare as booleans where both are `true`, `false`, `1` or `0`, else as floats, else as text, as upstream."""
    flags = _BOOLEANS.get(left.lower()), _BOOLEANS.get(right.lower())
    if None not in flags:
        return flags[0] == flags[1]
    try:
        return math.isclose(float(left), float(right))
    except ValueError:
        return left == right
