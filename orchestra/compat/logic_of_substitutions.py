"""Logic of Python on substitutions, as `not sim` or `sim and gui`, and the substitutions that were meant by it."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Final

from orchestra.compat.source_text import text_at
from orchestra.compat.syntax_trees import called_by, node_span

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.compat.syntax_trees import Tree

_LOGIC: Final = (ast.BoolOp, ast.UnaryOp, ast.Compare)
_DECIDING: Final = (
    ast.If,
    ast.While,
    ast.IfExp,
    ast.Assert,
    ast.comprehension,
    ast.ListComp,
    ast.GeneratorExp,
)
_COMPARING: Final = {ast.Eq: "EqualsSubstitution", ast.NotEq: "NotEqualsSubstitution"}


def logic_around(around: Iterable[ast.AST], tree: Tree, file: str) -> tuple[ast.expr, str] | None:
    """Return the whole of an expression of logic, and the substitution that stands for it; None for any other code.

    `around` are the nodes around a place, innermost first. What code decides by, as a test of `if`, is none.
    """
    whole: ast.expr | None = None
    for node in around:
        if isinstance(node, _LOGIC):
            whole = node
        elif isinstance(node, _DECIDING):
            return None
        elif whole is not None:
            break
    if not isinstance(whole, ast.BoolOp | ast.UnaryOp):
        return None
    made = _substitution(whole, tree, file)
    return None if made is None else (whole, made)


def is_substitution(node: ast.expr) -> bool:
    """Return whether an expression makes a substitution: it calls a class."""
    return isinstance(node, ast.Call) and (called_by(node) or "")[:1].isupper()


def _substitution(node: ast.expr, tree: Tree, file: str) -> str | None:
    match node:
        case ast.Constant(value=bool(value)):
            return repr(str(value).lower())
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            inner = _substitution(operand, tree, file)
            return None if inner is None else f"NotSubstitution({inner})"
        case ast.BoolOp(op=op, values=values):
            kind = "AndSubstitution" if isinstance(op, ast.And) else "OrSubstitution"
            made, *others = (_substitution(value, tree, file) for value in values)
            for other in others:
                made = None if made is None or other is None else f"{kind}({made}, {other})"
            return made
        case ast.Compare(left=left, ops=[ast.Eq() | ast.NotEq() as sign], comparators=[right]):
            return f"{_COMPARING[type(sign)]}({_text(left, file)}, {_text(right, file)})"
    return _text(node, file) if is_substitution(tree.meaning(node)) else None


def _text(node: ast.expr, file: str) -> str:
    return text_at(file, node_span(file, node, quotes=True))
