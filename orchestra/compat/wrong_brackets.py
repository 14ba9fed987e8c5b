"""Classes that are not called, with square brackets behind them or none at all, and calls that lack what is in them."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Final

from orchestra.compat.explanation import Explanation
from orchestra.compat.names_in_frames import value_of
from orchestra.compat.rewritten import Rewritten
from orchestra.compat.source_text import text_at
from orchestra.compat.syntax_trees import node_span, tree_of
from orchestra.errors import Code
from orchestra.fields import replace

if TYPE_CHECKING:
    from types import FrameType

    from orchestra.compat.place import Place
    from orchestra.compat.syntax_trees import Tree

_PERFORM: Final = "perform"
_MOST: Final = 100  # characters: what is longer is read better in the message alone
_TAKE_A_LIST: Final = ("GroupAction", "LaunchDescription", "PathJoinSubstitution")


def explained(error: TypeError, frame: FrameType, place: Place) -> Explanation | None:
    """Return what is wrong with the brackets of an expression; None where the fault is another."""
    tree = tree_of(place.file)
    node = None if tree is None else tree.expression(place.file, place.span)
    match node:
        case ast.Subscript(value=called, slice=given) if "not subscriptable" in str(error):
            return _in_square_brackets(called, given, frame, place)
        case ast.Call(func=ast.Attribute(attr="perform"), args=[], keywords=[]) if "'context'" in str(error):
            return None if tree is None else _without_context(node, tree, place)
        case ast.Call(func=ast.Attribute(value=ast.Name() as name)) if "missing" in str(error):
            return None if tree is None else _uncalled(name, frame, place, tree)
    if tree is not None and "unsupported operand" in str(error):
        return _added(tree, frame, place)
    return None


def _in_square_brackets(
    called: ast.expr, given: ast.expr, frame: FrameType, place: Place
) -> Explanation | None:
    kind = value_of(called, frame)
    if not isinstance(kind, type) or not kind.__module__.startswith("orchestra.compat."):
        return None
    items = given.elts if isinstance(given, ast.Tuple) else [given]
    code = ", ".join(map(ast.unparse, items))
    code = (
        f"{ast.unparse(called)}([{code}])"
        if kind.__name__ in _TAKE_A_LIST
        else f"{ast.unparse(called)}({code})"
    )
    message = f"{kind.__name__} is called with round brackets: {kind.__name__}(...)"
    meant = Rewritten(code) if len(code) <= _MOST else None
    return Explanation(message, Code.WRONG_TYPE, place.span, meant)


def _without_context(call: ast.Call, tree: Tree, place: Place) -> Explanation:
    """Return that a substitution is performed without the context, which the function around it may have."""
    context, called = tree.context_around(call), node_span(place.file, call.func)
    # The name and its brackets, without what is before them.
    at = replace(place.span, line=called.end_line, column=called.end_column - len(_PERFORM))
    meant = None if context is None else Rewritten(f"{_PERFORM}({context})")
    return Explanation("perform needs 'context'", Code.MISSING_KEY, at, meant)


def _uncalled(name: ast.Name, frame: FrameType, place: Place, tree: Tree) -> Explanation | None:
    """Return that a variable is a class, where that was meant to be called."""
    kind, made = value_of(name, frame), tree.meaning(name)
    is_ours = isinstance(kind, type) and kind.__module__.startswith("orchestra.compat.")
    if not is_ours or made is name or not isinstance(made, ast.Name | ast.Attribute):
        return None
    span = node_span(place.file, made)
    message = f"'{name.id}' is the class {getattr(kind, '__name__', '')}: brackets make an object of it"
    return Explanation(message, Code.WRONG_TYPE, span, Rewritten(f"{text_at(place.file, span)}()"))


def _added(tree: Tree, frame: FrameType, place: Place) -> Explanation | None:
    """Return how something is added to a launch description, where `+=` is written for it."""
    for node in tree.nodes:
        match node:
            case ast.AugAssign(target=ast.Name(id=name) as target, op=ast.Add(), value=value) if (
                node.lineno == place.span.line and hasattr(value_of(target, frame), "add_action")
            ):
                code = f"{name}.add_action({ast.unparse(value)})"
                meant = Rewritten(code) if len(code) <= _MOST else None
                message = f"actions are added to '{name}' by {name}.add_action(...)"
                return Explanation(message, Code.WRONG_TYPE, node_span(place.file, node), meant)
    return None
