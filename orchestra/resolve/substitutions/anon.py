"""`$(anon name)`: a name made unique.

Upstream appends host, process id and a random number, so that no two runs have the same name. Here the suffix follows
from the name and the launch file: a plan stays the same from run to run and can be compared.
"""

from __future__ import annotations

import re
from pathlib import PurePath
from typing import TYPE_CHECKING

from orchestra.resolve.context import POISON, Poison
from orchestra.resolve.substitutions.arguments import made

if TYPE_CHECKING:
    from orchestra.description.text import Call
    from orchestra.resolve.context import Context, Evaluated
    from orchestra.resolve.substitutions.arguments import Evaluate


def perform(call: Call, context: Context, evaluate: Evaluate) -> Evaluated:
    """Return the name with a suffix; `context.anonymous` gives the same name the same result again."""
    name = evaluate(call.arguments[0], context)
    if isinstance(name, Poison):
        return POISON
    made_before = context.anonymous.get(name.text)
    unique = made_before or _unique(name.text, context.file)
    context.anonymous[name.text] = unique
    return made(call, context, unique)


def _unique(name: str, file: str | None) -> str:
    """Return a name that ROS accepts where it accepts the given one; of the file, the folder does not count."""
    source = f"{name}\0{PurePath(file or '').name}"
    import hashlib  # noqa: PLC0415 - slow, and few launch files ask for it

    suffix = hashlib.blake2s(source.encode("utf-8", "surrogatepass"), digest_size=4).hexdigest()
    return re.sub(r"[.:-]", "_", f"{name}_{suffix}")
