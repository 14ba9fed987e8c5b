"""`$(dirname)` and `$(filename)`: where the launch file is that says so."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.resolve.context import POISON
from orchestra.resolve.substitutions.arguments import made

if TYPE_CHECKING:
    from orchestra.description.text import Call
    from orchestra.resolve.context import Context, Evaluated
    from orchestra.resolve.substitutions.arguments import Evaluate


def dirname(call: Call, context: Context, _evaluate: Evaluate) -> Evaluated:
    """Return the folder of the launch file."""
    if context.file is None:
        return _nowhere(call, context)
    return made(call, context, os.path.dirname(context.file))  # noqa: PTH120 - text in, text out


def filename(call: Call, context: Context, _evaluate: Evaluate) -> Evaluated:
    """Return the path of the launch file."""
    return _nowhere(call, context) if context.file is None else made(call, context, context.file)


def _nowhere(call: Call, context: Context) -> Evaluated:
    told = f"$({call.name}) needs a launch file, and this text is in none"
    context.problems.error(Code.NO_CURRENT_FILE, told, context.at(call.span))
    return POISON
