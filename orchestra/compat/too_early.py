"""Substitutions used as texts, which they only become when the launch file is visited."""

from __future__ import annotations

import re
from importlib import import_module
from typing import Final

from orchestra.compat.borrowed import ROOM
from orchestra.compat.explanation import Explanation

_CLASS: Final = re.compile(r"\b[A-Z]\w+")
_EXPORTING: Final = ("launch.substitutions", "launch_ros.substitutions")


def explained(error: TypeError) -> Explanation | None:
    """Return what to do about an error of Python's that names a substitution; None where it names none."""
    known = {name for package in _EXPORTING for name in import_module(f"{ROOM}.{package}").__all__}
    found = next((name for name in _CLASS.findall(str(error)) if name in known), None)
    if found is None:
        return None
    message = f"{found} is no text before the launch file is visited"
    notes = (
        "a list joins texts and substitutions: ['a', LaunchConfiguration('b')]",
        "PathJoinSubstitution joins the parts of a path",
        "a function that OpaqueFunction calls has the texts: LaunchConfiguration('b').perform(context)",
    )
    return Explanation(message, notes=notes)
