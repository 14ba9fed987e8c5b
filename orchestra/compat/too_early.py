"""Substitutions used as texts, which they only become when the launch file is visited."""

from __future__ import annotations

import ast
import re
from importlib import import_module
from typing import TYPE_CHECKING, Final

from orchestra.compat.borrowed import ROOM
from orchestra.compat.explanation import Explanation
from orchestra.compat.joined_texts import joined
from orchestra.compat.names_in_frames import value_of
from orchestra.compat.rewritten import Rewritten
from orchestra.compat.scopes import given_to
from orchestra.compat.source_text import text_at
from orchestra.compat.syntax_trees import called_by, node_span, tree_of

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType

    from orchestra.compat.place import Place
    from orchestra.compat.syntax_trees import Tree

_CLASS: Final = re.compile(r"\b[A-Z]\w+")
_EXPORTING: Final = ("launch.substitutions", "launch_ros.substitutions")
_IN_LISTS: Final = "a list joins texts and substitutions: ['a', LaunchConfiguration('b')]"
IN_PATHS: Final = "PathJoinSubstitution joins the parts of a path"
_IN_FUNCTIONS: Final = (
    "a function that OpaqueFunction calls has the texts: LaunchConfiguration('b').perform(context)"
)


def explained(error: TypeError, frame: FrameType, place: Place) -> Explanation | None:
    """Return what to do about an error of Python's that names a substitution, a function, a text or a number."""
    known = {name for package in _EXPORTING for name in import_module(f"{ROOM}.{package}").__all__}
    found = next((name for name in _CLASS.findall(str(error)) if name in known), None)
    if found is None:
        # Here, because only such mistakes need them.
        from orchestra.compat import call_meant, loops_meant, texts_as_numbers  # noqa: PLC0415

        return (
            call_meant.explained(error, frame, place)
            or texts_as_numbers.explained(error, frame, place)
            or loops_meant.explained(error, place)
        )
    message = f"{found} is no text before the launch file is visited"
    notes: tuple[str, ...] = (_IN_LISTS, IN_PATHS, _IN_FUNCTIONS)
    tree = tree_of(place.file)
    node = None if tree is None else tree.expression(place.file, place.span)
    if tree is None or node is None:
        return Explanation(message, notes=notes)
    whole = _whole_sum(node, tree)
    meant = joined(whole, tree, place.file)
    if meant is not None and isinstance(whole, ast.BinOp):
        return Explanation(message, span=node_span(place.file, whole), suggestion=meant, notes=notes)
    part = next((part for part in _parts(node) if _is_one(part, found, frame, tree)), None)
    if part is None:
        return Explanation(message, suggestion=meant, notes=notes)
    span, context = node_span(place.file, part), tree.context_around(part)
    if context is not None:
        performed = Rewritten(f"{text_at(place.file, span)}.perform({context})")
        return Explanation(message, span=span, suggestion=performed, notes=notes)
    if meant is not None:  # it stands for the whole call, not for the part of it that is wrong
        message += f": {IN_PATHS if meant.startswith('PathJoin') else 'a list joins such texts'}"
        notes = (f"did you mean '{meant}'?", _IN_FUNCTIONS)
    return Explanation(message, span=span, notes=notes)


def _whole_sum(node: ast.expr, tree: Tree) -> ast.expr:
    """Return the whole of what is added, of which Python has tried two items."""
    for around in tree.nodes[::-1]:  # what is inside comes last
        if isinstance(around, ast.BinOp) and isinstance(around.op, ast.Add) and around.left is node:
            node = around
    return node


def _parts(node: ast.expr) -> Iterator[ast.expr]:
    """Yield what a call is given, and the items of lists of that; of an operation the two sides."""
    match node:
        case ast.Call():
            yield from given_to(node)
        case ast.BinOp(left=left, right=right):
            yield from (left, right)


def _is_one(part: ast.expr, found: str, frame: FrameType, tree: Tree) -> bool:
    """Return whether an expression comes to an object of the class of a name."""
    return type(value_of(part, frame)).__name__ == found or called_by(tree.meaning(part)) == found
