"""Problems of Python files at the text that is wrong: what stands at a place is a whole expression there."""

from __future__ import annotations

import ast
import re
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.compat.as_texts import without_echoes
from orchestra.compat.belongings import without_needs
from orchestra.compat.glued_paths import without_slash
from orchestra.compat.gone_through import without_shared
from orchestra.compat.handed_on import where_written
from orchestra.compat.idle_logic import without_letters
from orchestra.compat.joined_words import without_what_is_joined
from orchestra.compat.late_loops import without_last_ones
from orchestra.compat.late_roots import without_followers
from orchestra.compat.literals import Literal, argument
from orchestra.compat.made_texts import part_of
from orchestra.compat.one_mistake import behind_exceptions, corrected_alike, together
from orchestra.compat.parameter_values import assigned, value_meant
from orchestra.compat.place import Argument
from orchestra.compat.returning_none import without_nothings
from orchestra.compat.rewritten import Rewritten
from orchestra.compat.source_text import quoted_in, text_at
from orchestra.compat.syntax_trees import node_span, tree_of
from orchestra.compat.trailing_commas import at_commas
from orchestra.compat.uncalled import without_methods
from orchestra.compat.unset_by import without_readings
from orchestra.compat.without_f import without_what_braces_cause
from orchestra.errors import Code
from orchestra.fields import replace
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.errors import Problem, Problems
    from orchestra.location import Span

_QUOTED: Final = re.compile(r"'([^']+)'")
_UNSET: Final = re.compile(r"no launch argument or variable ('\w+') is set here")
_SLASHES: Final = re.compile("/+")
_OPERATOR: Final = re.compile(r"&&|\|\||===|!==|<>|=<|=>")
_SHORT: Final = 2  # a text of so few letters may mean anything
_BETWEEN: Final = re.compile(r"[\s()$]+")


def point_into_code(problems: Problems) -> None:
    """Let problems of Python files stand at the text that is wrong, without those that only follow from another."""
    problems.amend(without_echoes(tuple(problems)))
    problems.amend(without_followers(tuple(problems)))
    problems.amend(without_readings(tuple(problems)))
    problems.amend(in_place)
    problems.amend(without_echoes(tuple(problems)))
    problems.amend(without_what_braces_cause(tuple(problems)))
    problems.amend(without_what_is_joined(tuple(problems)))
    problems.amend(without_last_ones(tuple(problems)))
    problems.amend(without_shared(tuple(problems)))
    problems.amend(without_letters(tuple(problems)))
    problems.amend(without_nothings(tuple(problems)))
    problems.amend(without_needs(tuple(problems)))
    problems.amend(without_methods(tuple(problems)))
    problems.amend(at_commas(tuple(problems)))
    problems.amend(together(tuple(problems)))
    problems.amend(corrected_alike(tuple(problems)))
    problems.amend(behind_exceptions(tuple(problems)))


def in_place(problem: Problem) -> Problem:
    """Return a problem at the text that is wrong, and whose suggestion can stand in place of it.

    Where no such text is found it stays at the expression, and a note says what was meant.
    """
    span, meant = problem.span, problem.suggestion
    if span is None or not span.file.endswith(".py") or problem.code is Code.SYNTAX:
        return problem  # there are no expressions in what is no Python
    if isinstance(meant, Rewritten):
        return replace(problem, span=whole(span), suggestion=str(meant))
    found = _found(span)
    given = where_written(problem, found.whole) or _given_as_text(problem, found)
    return _where_found(problem, span, found) if given is None else given


def _where_found(problem: Problem, span: Span, found: Literal) -> Problem:
    """Return the same, of an expression that has been found."""
    meant = problem.suggestion
    if problem.code is Code.DECLARED_TYPE and meant is not None and isinstance(span, Argument):
        value = value_meant(span, meant)
        if value is not None:
            return replace(problem, span=value[0], suggestion=str(value[1]))
    if isinstance(span, Argument):
        problem = replace(problem, span=found.span)
    root = _late_root(found) or _glued(found, problem.message) if problem.code is Code.MISSING_FILE else None
    if root is not None:
        return replace(problem, span=root[0], suggestion=root[1])
    if meant is None:
        undeclared = _UNSET.fullmatch(problem.message) if problem.code is Code.UNDEFINED_VARIABLE else None
        way = "" if undeclared is None else f"; DeclareLaunchArgument({undeclared[1]}) declares it"
        return replace(problem, span=_narrower(problem, found), message=problem.message + way)
    if problem.code is Code.UNKNOWN_DEPENDENCY and isinstance(found.node, ast.Constant):
        return replace(problem, span=found.span)  # a whole name
    is_name = not isinstance(span, Argument)  # else it may stand for what is wrong
    wrong = (
        part_of(found, meant, problem.message)
        or _wrong(found, meant, problem.message, is_name=is_name)
        or _elsewhere(found, meant, problem.message)
    )
    if wrong is None:
        return replace(problem, suggestion=None, notes=(*problem.notes, f"did you mean '{meant}'?"))
    return replace(problem, span=wrong[0], suggestion=wrong[1])


def _given_as_text(problem: Problem, found: Literal) -> Problem | None:
    """Return the problem of a text that gives a parameter, where the path of a file is taken."""
    text = found.node.value if isinstance(found.node, ast.Constant) else None
    if not isinstance(text, str):
        return None
    is_file = problem.code is Code.MISSING_FILE and "parameter file" in problem.message
    pair = assigned(text) if is_file else None
    if pair is None:
        return None
    told = f"parameters are dictionaries and files, there is no file '{text}': {pair} gives one"
    return replace(problem, message=told, span=found.whole, suggestion=pair)


def whole(span: Span) -> Span:
    """Return where an argument stands, a text with its quotes; any other place as it is."""
    return argument(span.place, span.path).whole if isinstance(span, Argument) else span


def _found(span: Span) -> Literal:
    """Return the expression at a place."""
    if isinstance(span, Argument):
        return argument(span.place, span.path)
    file = str(Path(span.file).absolute())
    tree = tree_of(file)
    node = None if tree is None else tree.expression(file, span)
    is_name = isinstance(node, ast.Name | ast.Attribute)  # what is told of is the name itself
    return Literal(file, None if is_name else node, span, tree)


def _late_root(found: Literal) -> tuple[Span, str] | None:
    """Return a later part of a joined path that begins at the root, and without: it drops what stands before it."""
    tree = tree_of(found.file)
    node = found.node if found.node is None or tree is None else tree.meaning(found.node)
    for part in _later_parts(node):
        if isinstance(part, ast.Constant) and isinstance(part.value, str) and part.value.startswith("/"):
            return node_span(found.file, part), part.value.lstrip("/")
    return None


def _glued(found: Literal, message: str) -> tuple[Span, str] | None:
    """Return a later part of a path that lacks the slash before it, and with it."""
    tree = tree_of(found.file)
    node = found.node if found.node is None or tree is None else tree.meaning(found.node)
    part = without_slash(node, message)
    return None if part is None else (node_span(found.file, part[0]), part[1])


def _later_parts(node: ast.expr | None) -> Sequence[ast.expr]:
    """Return the parts of a path that is joined, without the first."""
    match node:
        case ast.Call(func=ast.Attribute(attr="join"), args=[_, *parts]):
            return parts
        case ast.Call(func=ast.Name(id="PathJoinSubstitution"), args=[ast.List(elts=[_, *parts])]):
            return parts
        case ast.BinOp(left=left, op=ast.Div(), right=right):
            return [*_later_parts(left), right]
    return []


def _narrower(problem: Problem, found: Literal) -> Span:
    """Return where the last part of a path stands that is not there, the text of an expression, or a name in it."""
    if problem.code is Code.MISSING_FILE:
        name = problem.message.rpartition("/")[2].rpartition(" ")[2].strip("'")
        return found.texts.get(name, problem.span or found.span)
    if problem.code is Code.COMMAND_FAILED and isinstance(found.node, ast.Call):
        texts, program = found.texts, _QUOTED.search(problem.message)
        if program is not None and program[1] in texts:
            return texts[program[1]]
        if len(texts) == 1:
            return next(iter(texts.values()))
    return problem.span or found.span


def _wrong(found: Literal, meant: str, message: str, *, is_name: bool) -> tuple[Span, str] | None:
    """Return where the text stands that something else was meant by, and what should stand there.

    It is part of what the message tells of.
    """
    if found.node is None:  # a name, or the part of something
        written = text_at(found.file, found.span)
        is_sign = len(written) == 1 and not written.isspace() and not is_name
        is_sign = is_sign or (bool(_OPERATOR.fullmatch(written)) and not is_name)
        if is_sign or (written.replace(".", "").isidentifier() and (is_name or _stands(written, message))):
            return found.span, meant
        return next(_replaced(_told(quoted_in(found.file, found.span), message), meant), None)
    if isinstance(found.node, ast.Constant):
        text = str(found.node.value)
        whole = "$(" not in meant and _SLASHES.sub("/", text).count("/") == meant.count("/")
        return (found.span, meant) if whole else next(_replaced({text: found.span}, meant), None)
    return next(_replaced(_told(found.texts, message), meant), None)


def _elsewhere(found: Literal, meant: str, message: str) -> tuple[Span, str] | None:
    """Return the same for a text that stands but once in the file: it came there by a way that only running tells."""
    tree = tree_of(found.file)
    texts = {} if tree is None else tree.texts(found.file)
    return next(
        _replaced({text: span for text, span in _told(texts, message).items() if len(text) > _SHORT}, meant),
        None,
    )


def _told(texts: dict[str, Span], message: str) -> dict[str, Span]:
    """Return the texts that stand in a message; no pattern is made of those, of thousands, that do not at all."""
    return {text: span for text, span in texts.items() if text in message and _stands(text, message)}


def _stands(text: str, message: str) -> bool:
    begin, end = (r"(?<![\w.-])" if text[:1].strip("/") else ""), r"(?![\w-])"
    return bool(text) and re.search(begin + re.escape(text) + end, message) is not None


def _replaced(texts: dict[str, Span], meant: str) -> Iterator[tuple[Span, str]]:
    """Yield what should stand in place of which text, the likeliest first.

    `meant` may be a whole path, of which a text is a part.
    """
    near = nearest(meant, texts)
    if near is not None and "$(" not in meant and near.count("/") == meant.count("/"):
        yield texts[near], meant
    for text, place in texts.items():
        if _stands(text, meant):
            continue
        part = nearest(text, _parts(meant, text))
        if part is not None:
            yield place, part


def _parts(meant: str, text: str) -> Iterator[str]:
    """Yield the parts of a path, or of a text with substitutions, that have as many slashes as a text."""
    first = "/" if text.startswith("/") else ""
    count = text.removeprefix("/").count("/") + 1
    for token in _BETWEEN.split(meant):
        steps = token.split("/")
        for begin in range(len(steps) - count + 1):
            yield first + "/".join(steps[begin : begin + count]).removeprefix(first)
