"""Tuples that nothing but a comma at the end of a line makes: `share = get_package_share_directory('demo'),`."""

from __future__ import annotations

import ast
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.compat.explanation import Explanation
from orchestra.compat.source_text import text_at
from orchestra.compat.syntax_trees import called_by, node_span, tree_of
from orchestra.errors import Code, Severity
from orchestra.fields import replace
from orchestra.location import Location

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from orchestra.compat.place import Place
    from orchestra.compat.syntax_trees import Tree
    from orchestra.errors import Problem, Problems
    from orchestra.location import Span

NOTE: Final = "the comma at its end makes a tuple of it"
# What is told of a tuple, or of a list, and of the text that Python makes of one.
_SIGNS: Final = ("tuple", "list", "',)", ">,)")
# What a tuple becomes a list of values in.
_OF_VALUES: Final = frozenset({"Parameter", "ParameterValue", "SetParameter"})


def explained(error: BaseException, place: Place) -> Explanation | None:
    """Return that an exception comes of such a tuple; None where it does not."""
    tree = tree_of(place.file)
    node = None if tree is None or "tuple" not in str(error) else tree.expression(place.file, place.span)
    comma = None if tree is None or node is None else _comma_in(node, tree, place.file)
    if comma is None:
        return None
    return Explanation(f"{type(error).__name__}: {error}", span=comma, notes=(NOTE,))


def tell(path: str, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Warn of such tuples where they are compared, put into texts, or are the value of a parameter."""
    tree = tree_of(path)
    done: set[Span] = set()
    for name in () if tree is None else _taken(tree):
        comma = _comma_of(name, tree, path) if tree is not None else None
        if comma is not None and comma not in done:
            done.add(comma)
            message = f"{ast.unparse(name)} is a tuple, not what is in it"
            problems.warning(Code.WRONG_TYPE, message, Location(comma, chain), notes=(NOTE,))


def at_commas(problems: Iterable[Problem]) -> Callable[[Problem], Problem | None]:
    """Return what has problems of such tuples stand at the comma, once each."""
    moved: dict[int, Problem | None] = {}
    first: dict[Span, Problem] = {}
    tuples: dict[str, dict[int, ast.Tuple]] = {}
    for problem in problems:
        comma = _comma_told(problem, tuples)
        if comma is None:
            continue
        known = first.get(comma)
        if known is None:
            notes = problem.notes if NOTE in problem.notes else (NOTE,)
            first[comma] = replace(problem, span=comma, suggestion=None, notes=notes)
            moved[id(problem)] = first[comma]
            continue
        moved[id(problem)] = None
        if problem.severity is Severity.ERROR and known.severity is not Severity.ERROR:
            graver = replace(problem, span=comma, suggestion=None, notes=(NOTE,))
            moved = {key: graver if value is known else value for key, value in moved.items()}
            first[comma] = graver
    return lambda problem: moved.get(id(problem), problem)


def _comma_told(problem: Problem, tuples: dict[str, dict[int, ast.Tuple]]) -> Span | None:
    """Return the comma that a problem comes of, None where it comes of none.

    `tuples` are those of the files, by the `id` of themselves and of what is in them.
    """
    span = problem.span
    if span is None or not span.file.endswith(".py"):
        return None
    if NOTE in problem.notes:
        return span
    file = str(Path(span.file).absolute())
    tree = tree_of(file)
    if tree is None or file not in tuples:
        nodes = () if tree is None else tree.nodes
        made = [item for item in nodes if isinstance(item, ast.Tuple) and _comma(item, file)]
        tuples[file] = {id(part): item for item in made for part in (item, *item.elts)}
    node = tree.expression(file, span) if tree is not None and tuples[file] else None
    if tree is None or node is None:
        return None
    known = tuples[file].get(id(node))
    if known is not None and (node is known or problem.code is Code.WRONG_TYPE):
        return _comma(known, file)
    is_told = isinstance(node, ast.Name) or any(sign in problem.message for sign in _SIGNS)
    return _comma_in(node, tree, file) if is_told else None


def _comma_in(node: ast.expr, tree: Tree, file: str) -> Span | None:
    """Return the comma that makes a tuple of something in an expression."""
    names = (item for item in ast.walk(node) if isinstance(item, ast.Name))
    return next((comma for name in names if (comma := _comma_of(name, tree, file)) is not None), None)


def _comma_of(name: ast.expr, tree: Tree, file: str) -> Span | None:
    return _comma(tree.meaning(name), file) if isinstance(name, ast.Name) else None


def _comma(known: ast.expr, file: str) -> Span | None:
    """Return the comma of a tuple of one that has no brackets around it."""
    if not isinstance(known, ast.Tuple) or len(known.elts) != 1:
        return None
    span = node_span(file, known)
    comma = replace(span, line=span.end_line, column=span.end_column - 1)
    return comma if text_at(file, comma) == "," else None


def _taken(tree: Tree) -> Iterator[ast.expr]:
    """Yield what is used where a tuple surely does something else than what is in it."""
    arguments = {
        id(inner)
        for call in tree.nodes
        if isinstance(call, ast.Call)
        for word in call.keywords
        if word.arg in ("additional_env", "env", "launch_arguments")
        for inner in ast.walk(tree.meaning(word.value))
    }
    for node in tree.nodes:
        match node:
            case ast.Compare(left=left, comparators=[other], ops=[ast.Eq() | ast.NotEq()]):
                yield from (left, other)
            case ast.Compare(left=left, ops=[ast.In() | ast.NotIn()]):
                yield left
            case ast.FormattedValue(value=value):
                yield value
            case ast.Dict(values=values) if id(node) not in arguments:
                yield from values
            case ast.Call(args=[ast.List(elts=parts)]) if called_by(node) == "PathJoinSubstitution":
                yield from parts
            case ast.Call(args=given, keywords=words) if called_by(node) in _OF_VALUES:
                yield from (*given, *(word.value for word in words))
