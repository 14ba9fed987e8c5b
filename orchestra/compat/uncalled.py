"""Methods that code takes for what they return: the brackets behind their names are missing."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Final

from orchestra.compat.rewritten import Rewritten
from orchestra.compat.syntax_trees import called_by, node_span
from orchestra.errors import Code, Severity
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
_OF_TRUTHS: Final = {"IfCondition": "UnlessCondition", "UnlessCondition": "IfCondition"}
_TWO: Final = 2
_LOGIC: Final = "conditions of Python's are always true: substitutions have a logic of their own"


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
        logic = _logic(node, tree)
        if logic is not None:
            done.update(map(id, ast.walk(node)))
            span = node_span(path, logic[0])
            problems.warning(Code.IMPOSSIBLE_CONDITION, _LOGIC, Location(span, chain), suggestion=logic[1])
        for tested in _decided(node):
            if called_by(tree.meaning(tested)) in _CONDITIONS and id(tested) not in done:
                context = tree.context_around(tested) or "context"
                span = node_span(path, tested, quotes=True)
                message = "a condition of Python's is always true: evaluate(context) tells what it comes to"
                meant = Rewritten(f"{ast.unparse(tested)}.evaluate({context})")
                problems.warning(Code.IMPOSSIBLE_CONDITION, message, Location(span, chain), suggestion=meant)


def _logic(node: ast.AST, tree: Tree) -> tuple[ast.expr, Rewritten | None] | None:
    """Return what Python makes one condition of others by, and the condition that was meant, where that is known."""
    match node:
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            given = [operand]
        case ast.BoolOp(values=given):
            pass
        case _:
            return None
    calls = [tree.meaning(item) for item in given]
    if any(called_by(call) not in _OF_TRUTHS for call in calls):
        return None
    tested = [(called_by(call), call.args) for call in calls if isinstance(call, ast.Call)]
    if any(len(args) != 1 for _, args in tested):
        return node, None
    texts = [(str(name), ast.unparse(args[0])) for name, args in tested]
    if isinstance(node, ast.UnaryOp):
        return node, Rewritten(f"{_OF_TRUTHS[texts[0][0]]}({texts[0][1]})")
    kind = (
        "AndSubstitution"
        if isinstance(node, ast.BoolOp) and isinstance(node.op, ast.And)
        else "OrSubstitution"
    )
    inner = (text if name == "IfCondition" else f"NotSubstitution({text})" for name, text in texts)
    return node, Rewritten(f"IfCondition({kind}({', '.join(inner)}))") if len(texts) == _TWO else None


def without_methods(problems: Iterable[Problem]) -> Callable[[Problem], Problem | None]:
    """Return what leaves out the problems of a value that is a method, in a file where that is told."""
    files = {item.span.file for item in problems if item.span is not None and _NOT_CALLED in item.message}
    logic = {item.span: item for item in problems if item.message == _LOGIC}
    same = [item for item in problems if item.span in logic and item.message != _LOGIC]
    grave = {item.span for item in same if item.severity is Severity.ERROR}

    def kept(problem: Problem) -> Problem | None:
        if problem.span in logic:
            is_grave = problem.span in grave
            told = replace(problem, severity=Severity.ERROR) if is_grave else problem
            return told if problem.message == _LOGIC else None
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
