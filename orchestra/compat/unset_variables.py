"""Environment variables that code of a launch file asks for and that are not set."""

from __future__ import annotations

import ast
import os
from typing import TYPE_CHECKING

from orchestra.compat.explanation import Explanation
from orchestra.compat.place import Place, is_own
from orchestra.compat.seam import connection
from orchestra.compat.syntax_trees import node_span, tree_of
from orchestra.errors import Code, Severity
from orchestra.witness.origins import PYTHON

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import TracebackType

    from orchestra.location import Span


def explained(error: BaseException, call: TracebackType) -> Explanation | None:
    """Explain what an unset variable leads to, as far as that is sure; `call` is the user's line. None: nothing does.

    What code raises that copes with it is told so only where that is no error.
    """
    place = Place(call.tb_frame.f_code, call.tb_lasti)
    name = _asked_for(error)
    if name is not None:
        return _told(name, _key(place, name) or place.span)
    found = _stopped_for(error, place)
    told = None if found is None else _told(*found)
    return told if told is not None and told.severity is not Severity.ERROR else None


def _told(name: str, at: Span) -> Explanation:
    severity, told, meant = connection().unset_environment(name)
    return Explanation(told, Code.UNSET_ENVIRONMENT, at, meant, severity=severity)


def _asked_for(error: BaseException) -> str | None:
    """Return the variable that code has asked `os.environ` for in vain; None for any other error."""
    last = error.__traceback__
    while last is not None and last.tb_next is not None:
        last = last.tb_next
    if (
        last is None
        or not isinstance(error, KeyError)
        or last.tb_frame.f_locals.get("self") is not os.environ
    ):
        return None
    name = error.args[0] if error.args else None
    return name if isinstance(name, str) and name not in os.environ else None


def _key(place: Place, name: str) -> Span | None:
    """Return where the name stands as a key, None where it comes from elsewhere."""
    tree = tree_of(place.file)
    node = None if tree is None else tree.expression(place.file, place.span)
    if isinstance(node, ast.Subscript) and isinstance(node.slice, ast.Constant) and node.slice.value == name:
        return node_span(place.file, node.slice)
    return None


def _stopped_for(error: BaseException, place: Place) -> tuple[str, Span] | None:
    """Return the variable for want of which the code itself raises this, and where it has asked for it."""
    cause = error.__context__
    name = None if cause is None else _asked_for(cause)
    if cause is None or name is None or not (isinstance(error, SystemExit) or _raises(place)):
        return None
    asked = None
    for call in _calls(cause.__traceback__):
        asked = Place(call.tb_frame.f_code, call.tb_lasti)
    return None if asked is None else (name, _key(asked, name) or asked.span)


def _raises(place: Place) -> bool:
    tree = tree_of(place.file)
    nodes = () if tree is None else tree.nodes
    return any(isinstance(node, ast.Raise) and node.lineno == place.span.line for node in nodes)


def _calls(traceback: TracebackType | None) -> Iterator[TracebackType]:
    """Yield the lines of the user's that led to an error."""
    while traceback is not None:
        file = traceback.tb_frame.f_code.co_filename
        if not is_own(file) and not file.startswith(("<", *PYTHON)):
            yield traceback
        traceback = traceback.tb_next
