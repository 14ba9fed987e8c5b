"""`$(find-exec name)`: a program on the PATH."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.nearest import nearest
from orchestra.resolve.context import POISON, Poison
from orchestra.resolve.refusals import refuse
from orchestra.resolve.substitutions.arguments import made

if TYPE_CHECKING:
    from collections.abc import Iterator

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
    told = f"there is no program {name.text!r} on the PATH"
    return refuse(
        written, context, Code.MISSING_EXECUTABLE, told, meant=nearest(name.text, _programs(path)), notes=()
    )


def _programs(path: str) -> Iterator[str]:
    for folder in path.split(os.pathsep):
        try:
            yield from os.listdir(folder or os.curdir)  # noqa: PTH208 - names are all that is wanted
        except OSError:
            continue  # a PATH may name folders that are not there
