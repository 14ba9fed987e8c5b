"""Paths that begin anew at a later part: `os.path.join(share, '/config/a.yaml')` is `/config/a.yaml`."""

from __future__ import annotations

import ast
import os
from typing import TYPE_CHECKING, Final

from orchestra.compat.rewritten import Rewritten
from orchestra.compat.syntax_trees import called_by, node_span, tree_of
from orchestra.errors import Code, Severity
from orchestra.fields import replace
from orchestra.location import Location

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from orchestra.errors import Problem, Problems
    from orchestra.location import Span

_ANEW: Final = "the path begins anew at "


def tell(path: str, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Warn of parts of paths that leave out what stands before them, where nothing is there."""
    tree = tree_of(path)
    for node in () if tree is None else tree.nodes:
        for part, text in _late(_parts(node)):
            if not os.path.exists(text):  # noqa: PTH110 - pathlib is slow
                message = f"{_ANEW}'{text}': what stands before it does not count"
                at = Location(node_span(path, part), chain)
                problems.warning(Code.MISSING_FILE, message, at, suggestion=Rewritten(text.lstrip("/")))


def without_followers(problems: Iterable[Problem]) -> Callable[[Problem], Problem | None]:
    """Return what leaves out that files are missing which such a path names; what is told instead is as grave."""
    roots = {
        problem.message.split("'")[1]: problem for problem in problems if problem.message.startswith(_ANEW)
    }
    following = {
        id(problem): root
        for problem in problems
        for root in roots
        if problem.code is Code.MISSING_FILE and f" {root}" in problem.message
    }
    grave = {
        following[id(problem)]
        for problem in problems
        if id(problem) in following and problem.severity is Severity.ERROR
    }

    def kept(problem: Problem) -> Problem | None:
        if id(problem) in following:
            return None
        is_grave = any(roots[root] is problem for root in grave)
        return replace(problem, severity=Severity.ERROR) if is_grave else problem

    return kept


def _parts(node: ast.AST) -> Sequence[ast.expr]:
    match node:
        case ast.Call(func=ast.Attribute(attr="join", value=ast.Attribute(attr="path")), args=parts):
            return parts
        case ast.Call(args=[ast.List(elts=parts)]) if called_by(node) == "PathJoinSubstitution":
            return parts
    return ()


def _late(parts: Sequence[ast.expr]) -> Iterator[tuple[ast.expr, str]]:
    """Yield the parts behind the first one that begin with a slash, and their texts."""
    for part in parts[1:]:
        match part:
            case ast.Constant(value=str(text)) if text.startswith("/") and text.strip("/"):
                yield part, text
