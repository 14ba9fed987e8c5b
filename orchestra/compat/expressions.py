"""What Python expressions in launch files see."""

from __future__ import annotations

import importlib


def visible(modules: str) -> dict[str, object]:
    """Return the names that an expression sees of a comma-separated list of modules.

    Those of `math` need no prefix. Raises `ImportError`, and whatever a module raises while it is imported.
    """
    names: dict[str, object] = {}
    for name in filter(None, map(str.strip, modules.split(","))):
        module = importlib.import_module(name)
        names[name.partition(".")[0]] = importlib.import_module(name.partition(".")[0])
        if name == "math":
            names |= {member: value for member, value in vars(module).items() if not member.startswith("_")}
    return names
