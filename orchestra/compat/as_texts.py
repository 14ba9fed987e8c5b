"""Substitutions that code takes for texts or truth values before they have any: told where that is done."""

from __future__ import annotations

import ast
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.joined_texts import joined
from orchestra.compat.literals import argument
from orchestra.compat.logic_of_substitutions import is_substitution, logic_around
from orchestra.compat.place import Argument, Place
from orchestra.compat.refusing import collector
from orchestra.compat.remarks import remark
from orchestra.compat.rewritten import Rewritten
from orchestra.compat.scopes import decided_by
from orchestra.compat.source_text import text_at
from orchestra.compat.syntax_trees import called_by, node_span, tree_of
from orchestra.errors import Code, Problem, Severity
from orchestra.fields import replace
from orchestra.location import is_python
from orchestra.witness.origins import INSTALLED, PYTHON

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping
    from types import FrameType

    from orchestra.compat.syntax_trees import Tree
    from orchestra.location import Span

_EARLY: Final = "is no text before the launch file is visited"
AS_WRITTEN: Final = "what is written here is '"
_HAS_TEXT: Final = "a function that OpaqueFunction calls has the text: {}(...).perform(context)"
_CONDITIONS: Final = {"IfCondition", "UnlessCondition"}
# Functions whose texts people read: there is nothing wrong with a substitution among them.
_SHOWING: Final = frozenset(
    {"critical", "debug", "error", "exception", "info", "log", "pprint", "print", "repr", "warn", "warning"}
)


def tell_unequal(compared: object, text: str, frame: FrameType) -> None:
    """Warn of a comparison with a text in the code of a launch file."""
    name = type(compared).__name__
    notes = (
        "a condition compares when it is visited: IfCondition(EqualsSubstitution(a, b))",
        _HAS_TEXT.format(name),
    )
    message = f"{name} {_EARLY}: it is never equal to {text!r}, an IfCondition can tell"
    place = Place(frame.f_code, frame.f_lasti)
    node, meant = _logic(place) or (None, _judged(place))
    _tell(Code.IMPOSSIBLE_CONDITION, message, place, notes, node, meant)


def tell_true(tested: object, frame: FrameType) -> None:
    """Warn of a test whether a substitution is true, which it always is, where it surely is a substitution.

    What a helper is given may be one or nothing: that it asks which is no mistake.
    """
    place = Place(frame.f_code, frame.f_lasti)
    tree, name = _tree(place), type(tested).__name__
    found = () if tree is None else (node for around in _around(place, tree) for node in _tested(around))
    for node in found:
        if tree is not None and called_by(tree.meaning(node)) == name:
            notes = ("a condition is judged when it is visited: IfCondition(a)", _HAS_TEXT.format(name))
            message = f"{name} {_EARLY}: it always counts as true, an IfCondition can tell"
            context = tree.context_around(node)
            source = text_at(place.file, node_span(place.file, node))
            performed = None if context is None else Rewritten(f"{source}.perform({context}) == 'true'")
            is_text = name == "LaunchConfiguration"
            message += f": condition=IfCondition({source})" if context is None and is_text else ""
            whole, meant = _logic(place) or (node, performed if is_text else None)
            _tell(Code.IMPOSSIBLE_CONDITION, message, place, notes, whole, meant)
            return


def tell_written(written: object, frame: FrameType) -> None:
    """Warn of a substitution that is made part of a text, unless that is one for people."""
    place = Place(frame.f_code, frame.f_lasti)
    tree, name = _tree(place), type(written).__name__
    if tree is None or _is_shown(place, tree):
        return
    kinds = ast.JoinedStr, ast.BinOp, ast.Call
    node = next((node for node in _around(place, tree) if isinstance(node, kinds)), None)
    message = f"{name} {_EARLY}: {AS_WRITTEN}<{name}>'"
    notes = ("a list joins texts and substitutions: ['a', LaunchConfiguration('b')]", _HAS_TEXT.format(name))
    meant = None if node is None else joined(node, tree, place.file)
    _tell(Code.USER_CODE, message, place, notes, node, meant)


def without_echoes(problems: Iterable[Problem]) -> Callable[[Problem], Problem | None]:
    """Return what leaves out problems of texts that are told to be none: of what a substitution was written into.

    What is told is an error where one of them is.
    """
    told = {_mark(problem) for problem in problems} - {None}
    echoes = {id(problem): _echoed(problem, told) for problem in problems if told}
    places = {problem.span: problem for problem in problems if _EARLY in problem.message}
    grave = {problem.span for problem in problems if problem.severity is Severity.ERROR}
    stops = {echoes.get(id(problem)) for problem in problems if problem.severity is Severity.ERROR} - {None}

    def kept(problem: Problem) -> Problem | None:
        early = places.get(problem.span) or _meant_by(problem, places)
        if echoes.get(id(problem)) is not None or (early is not None and early is not problem):
            return None
        is_grave = _mark(problem) in stops or (early is not None and problem.span in grave)
        return replace(problem, severity=Severity.ERROR) if is_grave else problem

    return kept


def _meant_by(problem: Problem, places: Mapping[Span | None, Problem]) -> Problem | None:
    """Return what is told of the logic that was taken for a text, where it stands or where a name was set to it."""
    span = problem.span
    if not places or span is None or not is_python(span) or "found bool: " not in problem.message:
        return None
    span = argument(span.place, span.path).whole if isinstance(span, Argument) else span
    file = str(Path(span.file).absolute())
    tree = tree_of(file)
    node = None if tree is None else tree.expression(file, span)
    if tree is not None and isinstance(node, ast.Name):
        span = node_span(file, tree.meaning(node), quotes=True)
    return next((early for at, early in places.items() if at is not None and _is_same(at, span)), None)


def _is_same(one: Span, other: Span) -> bool:
    begins, ends = (one.line, one.column), (one.end_line, one.end_column)
    is_there = begins == (other.line, other.column) and ends == (other.end_line, other.end_column)
    return is_there and Path(one.file).name == Path(other.file).name


def _mark(problem: Problem) -> str | None:
    """Return what a problem tells to stand in texts, None where it tells of something else."""
    _, found, mark = problem.message.partition(AS_WRITTEN)
    return mark.removesuffix("'") if found else None


def _echoed(problem: Problem, told: set[str | None]) -> str | None:
    """Return which of the texts that are told a problem only follows from."""
    if _mark(problem) is not None or problem.span is None or not is_python(problem.span):
        return None
    return next((mark for mark in told if mark is not None and mark in problem.message), None)


def _judged(place: Place) -> Rewritten | None:
    """Return the substitution that compares, where a condition is given a comparison of code."""
    tree = tree_of(place.file)
    node = None if tree is None else tree.expression(place.file, place.span)
    match node:
        case ast.Compare(left=left, ops=[ast.Eq() | ast.NotEq() as sign], comparators=[right]):
            kind = "EqualsSubstitution" if isinstance(sign, ast.Eq) else "NotEqualsSubstitution"
            sides = (text_at(place.file, node_span(place.file, side, quotes=True)) for side in (left, right))
            around = () if tree is None else (called_by(item) for item in tree.nodes if _is_given(item, node))
            if set(around) & _CONDITIONS:
                return Rewritten(f"{kind}({', '.join(sides)})")
            return _performed(node, tree, place.file)
    return None


def _logic(place: Place) -> tuple[ast.expr, Rewritten] | None:
    """Return the whole of the logic around a place, and the substitution that was meant by it."""
    tree = _tree(place)
    found = None if tree is None else logic_around(_around(place, tree), tree, place.file)
    return None if found is None else (found[0], Rewritten(found[1]))


def _performed(node: ast.expr, tree: Tree | None, file: str) -> Rewritten | None:
    """Return a comparison with the text of the substitution in it, in a function that has the context."""
    if tree is None or not isinstance(node, ast.Compare):
        return None
    context = tree.context_around(node)
    sides = [node.left, *node.comparators]
    texts = [text_at(file, node_span(file, side, quotes=True)) for side in sides]
    early = [index for index, side in enumerate(sides) if is_substitution(tree.meaning(side))]
    if context is None or len(early) != 1:
        return None
    texts[early[0]] += f".perform({context})"
    return Rewritten(f"{texts[0]} {'==' if isinstance(node.ops[0], ast.Eq) else '!='} {texts[1]}")


def _is_given(call: ast.AST, node: ast.expr) -> bool:
    return isinstance(call, ast.Call) and any(item is node for item in call.args)


def _tree(place: Place) -> Tree | None:
    """Return the tree of the file of a launch; None for what is installed, which is not the user's to mend."""
    is_foreign = collector() is None or place.file.startswith((*INSTALLED, *PYTHON))
    return None if is_foreign else tree_of(place.file)


def _around(place: Place, tree: Tree) -> list[ast.expr | ast.stmt]:
    """Return the nodes around a place, innermost first."""
    span, found = place.span, []
    for node in tree.nodes:
        if node.lineno <= span.line and (node.end_lineno or 0) >= span.end_line:
            held = node_span(place.file, node, quotes=True)
            if (held.line, held.column) <= (span.line, span.column) and (span.end_line, span.end_column) <= (
                held.end_line,
                held.end_column,
            ):
                found.append((held, node))
    found.sort(key=lambda item: (item[0].line, item[0].column, -item[0].end_line, -item[0].end_column))
    return [node for _, node in reversed(found)]


def _tested(node: ast.AST) -> Iterator[ast.expr]:
    """Yield the expressions of which a node asks whether they are true."""
    for test in decided_by(node):
        yield from _leaves(test)
    match node:
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            yield from _leaves(operand)
        case ast.BoolOp(values=[*values, _]):
            for value in values:
                yield from _leaves(value)


def _leaves(test: ast.expr) -> Iterator[ast.expr]:
    match test:
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            yield from _leaves(operand)
        case ast.BoolOp(values=values):
            for value in values:
                yield from _leaves(value)
        case ast.Name() | ast.Call():
            yield test


def _is_shown(place: Place, tree: Tree) -> bool:
    """Return whether what stands at a place is for people to read."""
    return any(
        isinstance(node, ast.Raise | ast.Assert) or called_by(node) in _SHOWING
        for node in _around(place, tree)
    )


def _tell(
    code: Code,
    message: str,
    place: Place,
    notes: tuple[str, ...],
    node: Any = None,
    meant: str | None = None,
) -> None:
    span = place.span if node is None else node_span(place.file, node, quotes=True)
    remark(code, message, span, suggestion=meant, notes=notes)
