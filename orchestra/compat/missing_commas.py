"""Where a comma is missing in Python: behind the expression that another one follows.

CPython marks both expressions, from the first line of the first one: that may be a call of many lines. Where the second
one is in brackets the two are a call or an index, and fail when they are run.
"""

from __future__ import annotations

import ast
import token
from tokenize import TokenError, generate_tokens
from typing import TYPE_CHECKING, Final

from orchestra.compat.explanation import Explanation
from orchestra.compat.rewritten import Rewritten
from orchestra.compat.source_text import text_at
from orchestra.compat.syntax_trees import node_span, tree_of
from orchestra.fields import replace

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from tokenize import TokenInfo

    from orchestra.compat.place import Place
    from orchestra.location import Span

_LITERALS: Final = (
    ast.Constant,
    ast.Dict,
    ast.DictComp,
    ast.JoinedStr,
    ast.List,
    ast.ListComp,
    ast.Set,
    ast.Tuple,
)

_OPENING: Final = frozenset("([{")
_CLOSING: Final = frozenset(")]}")
_LAYOUT: Final = {"NL", "NEWLINE", "INDENT", "DEDENT", "COMMENT", "ENCODING"}
_WORDS: Final = {"NAME", "NUMBER", "STRING", "FSTRING_START", "FSTRING_END"}
_OPERATORS: Final = {"and", "as", "else", "for", "from", "if", "in", "is", "lambda", "not", "or"}


def narrowed(error: SyntaxError, span: Span, lines: Sequence[str]) -> tuple[Span, str | None]:
    """Return what lacks a comma, and that with its comma; `span` is what CPython marks.

    Of an expression of several lines it is the bracket at its end. In a dictionary it may be a colon that is missing.
    """
    if "forgot a comma" not in (error.msg or ""):
        return span, None
    last, within = _before_the_gap(span, lines)
    if last is None or within == "{":
        return span, None
    begin = (span.line, span.column) if last.end[0] == span.line else (last.start[0], last.start[1] + 1)
    place = replace(span, line=begin[0], column=begin[1], end_line=last.end[0], end_column=last.end[1] + 1)
    return place, f"{lines[place.line - 1][place.column - 1 : place.end_column - 1]},"


def before_brackets(error: TypeError, place: Place) -> Explanation | None:
    """Return that what is called, or asked for an item by no number, is a literal; None where it is none."""
    tree = tree_of(place.file)
    node = None if tree is None else tree.expression(place.file, place.span)
    match node:
        case ast.Call(func=literal):
            pass
        case ast.Subscript(value=literal, slice=item) if isinstance(item, _LITERALS):
            pass
        case _:
            return None
    if not isinstance(literal, _LITERALS):
        return None
    span = node_span(place.file, literal, quotes=True)
    if span.line != span.end_line:
        span = replace(span, line=span.end_line, column=span.end_column - 1)
    message = f"TypeError: {error}; perhaps a comma is missing"
    return Explanation(message, span=span, suggestion=Rewritten(f"{text_at(place.file, span)},"))


def _before_the_gap(span: Span, lines: Sequence[str]) -> tuple[TokenInfo | None, str]:
    """Return the last token of the expression that begins at a place and is followed by another, and its bracket."""
    brackets: list[str] = []
    depth, before = None, None
    for item in _tokens(lines):
        if depth is None and item.start >= (span.line, span.column - 1):
            depth = len(brackets)
        if depth == len(brackets) and before is not None and _is_gap(before, item):
            return before, brackets[-1] if brackets else ""
        if item.string in _OPENING:
            brackets.append(item.string)
        elif item.string in _CLOSING and brackets:
            brackets.pop()
        before = item if depth is not None else None
    return None, ""


def _is_gap(before: TokenInfo, item: TokenInfo) -> bool:
    """Tell whether one expression ends and another one begins; texts side by side are one."""
    kinds = [token.tok_name[each.type] for each in (before, item)]
    if all(kind in {"STRING", "FSTRING_START", "FSTRING_END"} for kind in kinds):
        return False
    ends = before.string in _CLOSING or (kinds[0] in _WORDS and before.string not in _OPERATORS)
    return ends and kinds[1] in _WORDS and item.string not in _OPERATORS


def _tokens(lines: Sequence[str]) -> Iterator[TokenInfo]:
    source = iter(lines)
    try:
        for item in generate_tokens(lambda: next(source, "")):
            if token.tok_name[item.type] not in _LAYOUT:
                yield item
    except (TokenError, SyntaxError):
        return  # what is behind is of no use
