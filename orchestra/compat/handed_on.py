"""Where a text stands that code hands on: the name of an argument among keywords, a value among those of a call.

What is told of stands where it is used, as `arguments.items()` in a function: the mistake is where it is written.
"""

from __future__ import annotations

import ast
import re
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.compat.rewritten import Rewritten, rewritten
from orchestra.compat.scopes import parameters
from orchestra.compat.source_text import text_at
from orchestra.compat.syntax_trees import node_span, tree_of
from orchestra.errors import Code
from orchestra.fields import replace

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.compat.syntax_trees import Tree
    from orchestra.errors import Problem
    from orchestra.location import Span

_ARGUMENT: Final = re.compile(r"has no argument '(\w+)'")
_VALUE: Final = re.compile(r"(?:not|found|is) '([^']+)'")
_LIST: Final = "an action is expected here, this is a list"
_NAME: Final = re.compile(r"\w+")
_SHORT: Final = 2  # a text of so few letters may mean anything


def where_written(problem: Problem, span: Span) -> Problem | None:
    """Return the problem of something at the place where it is written, None where it is not known to be another."""
    file = str(Path(span.file).absolute())
    tree = tree_of(file)
    if tree is None:
        return None
    if problem.message.startswith(_LIST):
        return _appended(problem, span, tree, file)
    if problem.code in (Code.UNKNOWN_ARGUMENT, Code.UNREAD_ARGUMENT):
        name = _ARGUMENT.search(problem.message)
        if name is None or name[1] in text_at(file, span):
            return None
        found = list(_named(name[1], tree, file))
        return replace(problem, span=found[0]) if len(found) == 1 else None
    value = _VALUE.search(problem.message) if problem.code is Code.WRONG_TYPE else None
    if value is None or len(value[1]) <= _SHORT or not _is_given(span, tree, file):
        return None
    texts = [node for node in tree.nodes if isinstance(node, ast.Constant) and node.value == value[1]]
    if len(texts) != 1:
        return None
    whole = node_span(file, texts[0], quotes=True)
    meant = rewritten(file, whole, value[1], problem.message)
    if meant is not None:
        return replace(problem, span=whole, suggestion=str(meant))
    is_code = isinstance(problem.suggestion, Rewritten)
    return replace(problem, span=whole if is_code else node_span(file, texts[0]))


def _appended(problem: Problem, span: Span, tree: Tree, file: str) -> Problem | None:
    """Return the problem of a list in a list at the only call that can have put it there."""
    names = set(_NAME.findall(text_at(file, span)))
    found: list[ast.Attribute] = []
    for node in tree.nodes:
        match node:
            case ast.Call(func=ast.Attribute(value=ast.Name(id=name), attr="append") as method, args=[given]):
                if name in names and isinstance(tree.meaning(given), ast.List | ast.ListComp):
                    found.append(method)
    if len(found) != 1:
        return None
    whole = node_span(file, found[0])
    at = replace(whole, line=whole.end_line, column=whole.end_column - len(found[0].attr))
    return replace(problem, span=at, suggestion="extend", notes=())


def _named(name: str, tree: Tree, file: str) -> Iterator[Span]:
    """Yield where a name stands as a text, or as a keyword."""
    for node in tree.nodes:
        if isinstance(node, ast.Constant) and node.value == name:
            yield node_span(file, node)
        elif isinstance(node, ast.Call):
            yield from (node_span(file, word) for word in node.keywords if word.arg == name)


def _is_given(span: Span, tree: Tree, file: str) -> bool:
    """Return whether what stands at a place is what a function is given."""
    node = tree.expression(file, span)
    if not isinstance(node, ast.Name):
        return False
    return any(node.id in parameters(function) for function in tree.functions_around(node))
