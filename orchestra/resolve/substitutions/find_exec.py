"""`$(find-exec name)`: a program on the PATH."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from orchestra.resolve.context import POISON, Poison
from orchestra.resolve.substitutions.arguments import made

if TYPE_CHECKING:
    from orchestra.description.text import Call
    from orchestra.resolve.context import Context, Evaluated
    from orchestra.resolve.substitutions.arguments import Evaluate


def perform(call: Call, context: Context, evaluate: Evaluate) -> Evaluated:
    """Return the absolute path of the program; the PATH is that of the description's environment."""
    written = call.arguments[0]
    name = evaluate(written, context)
    if isinstance(name, Poison):
        return POISON
    path = context.environment.get("PATH", os.defpath)
    import shutil  # noqa: PLC0415 - slow, and few launch files ask for it

    found = shutil.which(name.text, path=path)
    if found is not None:
        return made(call, context, os.path.abspath(found))  # noqa: PTH100 - a link must stay a link
    # Here, because only what is missing needs it.
    from orchestra.resolve.faulty_commands import report_program  # noqa: PLC0415

    report_program(name.text, written.span, context)
    return POISON
