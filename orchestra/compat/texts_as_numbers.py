"""Texts that code takes for numbers, and numbers that it takes for texts: what makes the one of the other."""

from __future__ import annotations

import ast
import re
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.explanation import Explanation, in_their_words
from orchestra.compat.names_in_frames import value_of
from orchestra.compat.performed_texts import known_of, performed
from orchestra.compat.rewritten import Rewritten
from orchestra.compat.source_text import text_at
from orchestra.compat.syntax_trees import node_span, tree_of

if TYPE_CHECKING:
    from types import FrameType

    from orchestra.compat.place import Place
    from orchestra.compat.syntax_trees import Tree

_ABOUT: Final = re.compile(
    r"not supported between instances of .*'str'|cannot be interpreted as an integer|can only concatenate str"
    r"|unsupported operand type\(s\) for [^ ]+: .*'str'|can't multiply sequence by non-int|must be real number, not str"
    r"|bad operand type for"
)
_NUMBER: Final = re.compile(r"\s*[-+]?(\d+)?(\.\d*)?\s*")
_MOST: Final = 100


def explained(error: TypeError, frame: FrameType, place: Place) -> Explanation | None:
    """Return what is to be made of a text or a number; None where the fault is another."""
    tree = tree_of(place.file)
    node = None if tree is None else tree.expression(place.file, place.span)
    if tree is None or node is None or not _ABOUT.search(str(error)):
        return None
    message = f"TypeError: {in_their_words(str(error))}"
    match node:
        case ast.BinOp(left=left, right=right) | ast.Compare(left=left, comparators=[right]):
            for part in (left, right):
                made = _made(part, right if part is left else left, (tree, frame, place.file))
                if made is not None:
                    whole = text_at(place.file, node_span(place.file, node, quotes=True))
                    source = text_at(place.file, node_span(place.file, part, quotes=True))
                    before, after = (
                        ("", whole.removeprefix(source)) if part is left else (whole.removesuffix(source), "")
                    )
                    meant = f"{before}{made}{after}"
                    is_short = "\n" not in meant and len(meant) <= _MOST
                    return Explanation(message, suggestion=Rewritten(meant) if is_short else None)
        case ast.Call(args=given):
            for part in given:
                made = _made(part, None, (tree, frame, place.file))
                if made is not None:
                    span = node_span(place.file, part, quotes=True)
                    return Explanation(message, span=span, suggestion=Rewritten(made))
    return None


def _made(part: ast.expr, other: ast.expr | None, around: tuple[Tree, FrameType, str]) -> str | None:
    """Return a part of an expression as the number, or the text, that the other part needs."""
    tree, frame, file = around
    source = text_at(file, node_span(file, part, quotes=True))
    value = _value(part, tree, frame)
    others = None if other is None else _value(other, tree, frame)
    if isinstance(value, str) and not isinstance(others, str):
        number = _NUMBER.fullmatch(value)
        is_one = number is not None and any(number.groups())
        return f"{'float' if number is not None and number[2] else 'int'}({source})" if is_one else None
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if is_number and isinstance(others, str) and _NUMBER.fullmatch(others) is None:
        return f"str({source})"
    return None


def _value(part: ast.expr, tree: Tree, frame: FrameType) -> Any:
    """Return what a part comes to, as far as that is known; of a performed text what the file has for it."""
    if isinstance(part, ast.Constant):
        return part.value
    value = value_of(part, frame)
    if value is None:
        name = performed(part, tree)
        return None if name is None else known_of(name, tree).default or "0"
    return value
