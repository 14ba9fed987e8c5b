"""Functions and classes that stand in place of what they make: the call that was meant."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from orchestra.compat.explanation import Explanation
from orchestra.compat.forms_of_sets import with_colon
from orchestra.compat.named_calls import CALLED, call_of
from orchestra.compat.names_in_frames import value_of
from orchestra.compat.rewritten import Rewritten
from orchestra.compat.scopes import given_to
from orchestra.compat.source_text import text_at
from orchestra.compat.syntax_trees import node_span, tree_of
from orchestra.errors import Code

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType

    from orchestra.compat.place import Place


def explained(error: BaseException, frame: FrameType, place: Place) -> Explanation | None:
    """Return that part of an expression is a function which is not called; None where the fault is another."""
    tree = tree_of(place.file)
    node = None if tree is None else tree.expression(place.file, place.span)
    if node is not None and "dictionary update sequence" in str(error):
        return _of_set(node, place.file)
    words = ("function", "method", "type")
    if tree is None or node is None or not any(word in str(error) for word in words):
        return None
    for part in _parts(node):
        value = value_of(part, frame) if isinstance(part, ast.Name | ast.Attribute) else None
        if isinstance(value, CALLED):
            name = part.attr if isinstance(part, ast.Attribute) else ast.unparse(part)
            message = f"{name} is not called: {name}(...) has the value"
            source = text_at(place.file, node_span(place.file, part))
            code = call_of(source, value, tree)
            meant = None if code is None else Rewritten(code)
            return Explanation(message, Code.WRONG_TYPE, node_span(place.file, part), meant)
    return None


def _of_set(node: ast.expr, file: str) -> Explanation | None:
    """Return the dictionary that was meant by the set which a call is given."""
    given = [item for item in node.args if isinstance(item, ast.Set)] if isinstance(node, ast.Call) else []
    meant = with_colon(text_at(file, node_span(file, given[0]))) if len(given) == 1 else None
    if meant is None:
        return None
    message = "a set is no dictionary: a colon makes one of it"
    return Explanation(message, Code.WRONG_TYPE, node_span(file, given[0]), Rewritten(meant))


def _parts(node: ast.expr) -> Iterator[ast.expr]:
    """Yield what an expression is made of, without what is called in it."""
    match node:
        case ast.Call():
            yield from given_to(node)
        case ast.BinOp(left=left, right=right):
            yield from _parts(left)
            yield from (left, right)
        case ast.Compare(left=left, comparators=others):
            yield from (left, *others)
