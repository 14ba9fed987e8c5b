"""`$(path-join component...)` and `$(string-join delimiter text...)`."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from orchestra.resolve.context import POISON
from orchestra.resolve.substitutions.arguments import made, texts

if TYPE_CHECKING:
    from orchestra.description.text import Call
    from orchestra.resolve.context import Context, Evaluated
    from orchestra.resolve.substitutions.arguments import Evaluate


def path(call: Call, context: Context, evaluate: Evaluate) -> Evaluated:
    """Return a path; an absolute component discards what precedes it (`os.path.join`, as upstream)."""
    words = texts(call, context, evaluate)
    return POISON if words is None else made(call, context, os.path.join(*words))  # noqa: PTH118 - it may be symbolic


def string(call: Call, context: Context, evaluate: Evaluate) -> Evaluated:
    """Return texts with the delimiter, the first argument, between them."""
    words = texts(call, context, evaluate)
    return POISON if words is None else made(call, context, words[0].join(words[1:]))
