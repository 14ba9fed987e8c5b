"""Substitutions used as texts, which they only become when the launch file is visited."""

from __future__ import annotations

import re
from importlib import import_module
from typing import TYPE_CHECKING, Final

from orchestra.compat.borrowed import ROOM
from orchestra.compat.explanation import Explanation
from orchestra.compat.joined_texts import joined
from orchestra.compat.place import Place, is_own
from orchestra.compat.syntax_trees import tree_of
from orchestra.witness.origins import PYTHON

if TYPE_CHECKING:
    from types import TracebackType

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
    return Explanation(message, suggestion=_joined(error.__traceback__), notes=notes)


def _joined(traceback: TracebackType | None) -> str | None:
    """Return the list that was meant by the innermost expression of the user's; None where that is none of texts."""
    place = None
    while traceback is not None:
        code = traceback.tb_frame.f_code
        if not is_own(code.co_filename) and not code.co_filename.startswith(("<", *PYTHON)):
            place = Place(code, traceback.tb_lasti)
        traceback = traceback.tb_next
    tree = None if place is None else tree_of(place.file)
    node = None if place is None or tree is None else tree.expression(place.file, place.span)
    return None if place is None or tree is None or node is None else joined(node, tree, place.file)
