"""Methods that code takes for what they return: the brackets behind their names are missing."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Final

from orchestra.compat.rewritten import Rewritten
from orchestra.compat.syntax_trees import called_by, node_span
from orchestra.errors import Code
from orchestra.fields import replace
from orchestra.location import Location

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from orchestra.compat.syntax_trees import Tree
    from orchestra.errors import Problem, Problems
    from orchestra.location import Span

_WITH_CONTEXT: Final = frozenset({"evaluate", "perform"})
_ALONE: Final = frozenset(
    {
        *("as_posix", "capitalize", "casefold", "exists", "is_dir", "is_file", "isdigit", "lower", "lstrip"),
        *("read", "read_text", "rstrip", "strip", "toprettyxml", "toxml", "upper"),
    }
)
_OF_PATHS: Final = frozenset({"exists", "isdir", "isfile"})
_OF_LIMITS: Final = frozenset({"lower", "upper"})
_CALLING: Final = frozenset({"filter", "filterfalse", "map", "max", "min", "partial", "sorted"})
_NOT_CALLED: Final = " is not called: "
_CONDITIONS: Final = frozenset(
    {"IfCondition", "LaunchConfigurationEquals", "LaunchConfigurationNotEquals", "UnlessCondition"}
)


def tell_uncalled(path: str, tree: Tree, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Warn of such methods in a file, and of conditions that are asked whether they are true."""
    called = set(_functions(tree))
    is_of_limits = {node.attr for node in tree.nodes if isinstance(node, ast.Attribute)} >= _OF_LIMITS
    done: set[int] = set()
    for node in tree.nodes:
        for found in _values(node, called):
            at = _method(found, tree)
            if is_of_limits and found.attr in _OF_LIMITS:
                continue  # of a joint, as its description has them
            if at is not None and id(found) not in done:
                done.add(id(found))
                _tell(path, found, at, problems, chain)
        for tested in _decided(node):
            if called_by(tree.meaning(tested)) in _CONDITIONS:
                context = tree.context_around(tested) or "context"
                span = node_span(path, tested, quotes=True)
                message = "a condition of Python's is always true: evaluate(context) tells what it comes to"
                meant = Rewritten(f"{ast.unparse(tested)}.evaluate({context})")
                problems.warning(Code.IMPOSSIBLE_CONDITION, message, Location(span, chain), suggestion=meant)


def without_methods(problems: Iterable[Problem]) -> Callable[[Problem], Problem | None]:
    """Return what leaves out the problems of a value that is a method, in a file where that is told."""
    files = {item.span.file for item in problems if item.span is not None and _NOT_CALLED in item.message}

    def kept(problem: Problem) -> Problem | None:
        is_there = problem.span is not None and problem.span.file in files
        is_of_method = "method" in problem.message and _NOT_CALLED not in problem.message
        return None if is_there and is_of_method else problem

    return kept


def _tell(path: str, found: ast.Attribute, meant: str, problems: Problems, chain: tuple[Span, ...]) -> None:
    whole = node_span(path, found)
    span = replace(whole, line=whole.end_line, column=whole.end_column - len(found.attr))
    is_known = not meant.endswith("(")
    message = f"{found.attr}{_NOT_CALLED}{meant if is_known else found.attr + '(...)'} has the value"
    problems.warning(
        Code.USER_CODE, message, Location(span, chain), suggestion=Rewritten(meant) if is_known else None
    )


def _functions(tree: Tree) -> Iterator[str]:
    """Yield the names that code calls, or hands over to what does."""
    for node in tree.nodes:
        if isinstance(node, ast.Call):
            handing = called_by(node) in _CALLING
            given = (*node.args, *(word.value for word in node.keywords)) if handing else ()
            yield from (item.id for item in (node.func, *given) if isinstance(item, ast.Name))


def _method(found: ast.Attribute, tree: Tree) -> str | None:
    """Return the call of a method that is none; of one that needs more than is known its beginning."""
    is_of_path = isinstance(found.value, ast.Attribute) and found.value.attr == "path"
    if is_of_path:
        return f"{found.attr}(" if found.attr in _OF_PATHS else None
    if isinstance(found.value, ast.Name) and found.value.id == "str":
        return None
    if found.attr in _WITH_CONTEXT:
        return f"{found.attr}({tree.context_around(found) or 'context'})"
    return f"{found.attr}()" if found.attr in _ALONE else None


def _values(node: ast.AST, called: set[str]) -> Iterator[ast.Attribute]:
    """Yield the attributes whose value something is made of."""
    found: list[ast.expr] = []
    match node:
        case ast.Compare(left=left, comparators=others):
            found = [left, *others]
        case ast.BinOp(left=left, right=right):
            found = [left, right]
        case ast.FormattedValue(value=value):
            found = [value]
        case ast.Assign(targets=[ast.Name(id=name)], value=value) if name not in called:
            found = [value]
        case _:
            found = list(_decided(node))
    yield from (item for item in found if isinstance(item, ast.Attribute))


def _decided(node: ast.AST) -> Iterator[ast.expr]:
    """Yield what a statement or an expression decides by."""
    match node:
        case ast.If(test=test) | ast.While(test=test) | ast.IfExp(test=test):
            yield test
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            yield operand
        case ast.BoolOp(values=values):
            yield from values
