"""Comments in Python, and the text at the top of the module that says what it is."""

from __future__ import annotations

import ast
import io
import tokenize
from inspect import cleandoc

from orchestra.convert.comments.found import Comment, Scan, text_of


def scan(text: str) -> Scan:
    """Return the comments of a text that is known to be Python."""
    found = []
    lines = text.split("\n")
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            line, column = token.start
            words = text_of(token.string)
            if words is not None:
                found.append(Comment((words,), line, column + 1, line, lines[line - 1][:column].strip()))
    body = ast.parse(text).body
    told = _docstring(body[0]) if body else None
    if told is not None:
        found.append(told)
    rest = body[1:] if told is not None else body
    content = rest[0].lineno if rest else len(lines) + 1
    return Scan(tuple(sorted(found, key=lambda comment: (comment.line, comment.column))), content)


def _docstring(first: ast.stmt) -> Comment | None:
    match first:
        case ast.Expr(value=ast.Constant(value=str(text))) if text.strip():
            lines = tuple(line.rstrip() for line in cleandoc(text).strip().split("\n"))
            return Comment(lines, first.lineno, first.col_offset + 1, first.end_lineno or first.lineno, "")
    return None
