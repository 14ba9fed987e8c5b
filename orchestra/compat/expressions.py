"""What Python expressions in launch files see."""

from __future__ import annotations

import importlib
import math
from functools import cache


def visible(modules: str) -> dict[str, object]:
    """Return the names that an expression sees of a comma-separated list of modules.

    Those of `math` need no prefix. Raises `ImportError`, and whatever a module raises while it is imported.
    """
    names: dict[str, object] = {}
    for name in filter(None, map(str.strip, modules.split(","))):
        module = importlib.import_module(name)
        top = name.partition(".")[0]
        names[top] = module if top == name else importlib.import_module(top)
        if name == "math":
            names |= _members_of_math()
    return names


@cache  # most expressions see them
def _members_of_math() -> dict[str, object]:
    return {member: value for member, value in vars(math).items() if not member.startswith("_")}
