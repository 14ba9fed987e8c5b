"""Comparisons, tests and statements of Python that are always so, or do nothing: `if mode == 'sim' or 'real':`."""

from __future__ import annotations

import ast
import re
from typing import TYPE_CHECKING, Final, NamedTuple

from orchestra.compat.explanation import Explanation
from orchestra.compat.rewritten import Rewritten
from orchestra.compat.scopes import decided_by
from orchestra.compat.signs import METHODS_OF_TEXTS
from orchestra.compat.source_text import text_at
from orchestra.compat.syntax_trees import called_by, node_span, tree_of
from orchestra.errors import Code
from orchestra.fields import replace
from orchestra.location import Location

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from orchestra.compat.place import Place
    from orchestra.compat.syntax_trees import Tree
    from orchestra.errors import Problem, Problems
    from orchestra.location import Span

# What returns texts.
_TEXTS: Final = frozenset({"get_package_share_directory", "join", "perform", "str"})
_LETTERS: Final = "the loop goes through the letters of "
_OF_LETTERS: Final = frozenset(
    {Code.BAD_NAME, Code.DUPLICATE_NODE, Code.MISSING_EXECUTABLE, Code.MISSING_FILE, Code.MISSING_PACKAGE}
)
# Letters that stand for something one by one, and the names of what is one of them.
_ONE_BY_ONE: Final = frozenset(
    {"lr", "nesw", "nsew", "rgb", "bgr", "rgba", "bgra", "rpy", "xyt", "xyzw", "wxyz"}
)
_OF_ONE: Final = re.compile(r"(?:.*_)?(?:axis|c|ch|char|character|digit|letter|sign|symbol)\d*")
_MOST: Final = 100  # characters: what is longer is read better in the message alone


class _Fault(NamedTuple):
    node: ast.expr | ast.stmt
    message: str
    meant: str | None


def tell(path: str, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Warn of such code in a file."""
    tree = tree_of(path)
    for fault in () if tree is None else _faults(tree, path):
        meant = Rewritten(fault.meant) if fault.meant is not None and len(fault.meant) <= _MOST else None
        span = node_span(path, fault.node, quotes=True)
        problems.warning(Code.USER_CODE, fault.message, Location(span, chain), suggestion=meant)


def without_letters(problems: Iterable[Problem]) -> Callable[[Problem], Problem | None]:
    """Return what leaves out what single letters are refused for, in a file where a loop goes through some."""
    files = {
        item.span.file for item in problems if item.span is not None and item.message.startswith(_LETTERS)
    }

    def kept(problem: Problem) -> Problem | None:
        is_there = problem.span is not None and problem.span.file in files
        return None if is_there and problem.code in _OF_LETTERS and problem.suggestion is None else problem

    return kept


def unset_by_colon(error: NameError, place: Place) -> Explanation | None:
    """Return that a name is not set since a colon stands in place of its sign; None where that is not so."""
    tree = tree_of(place.file)
    for node in () if tree is None else tree.nodes:
        match node:
            case ast.AnnAssign(target=ast.Name(id=name), annotation=value, value=None) if f"'{name}'" in str(
                error
            ):
                if isinstance(value, ast.Call | ast.List | ast.Dict | ast.JoinedStr | ast.Constant):
                    told = f"a colon says what '{name}' is to be, and sets nothing"
                    meant = Rewritten(f"{name} = {ast.unparse(value)}")
                    return Explanation(told, span=node_span(place.file, node), suggestion=meant)
    return None


def _faults(tree: Tree, path: str) -> Iterator[_Fault]:
    for node in tree.nodes:
        for test in decided_by(node):
            yield from _alternatives(test)
        match node:
            case ast.Compare():
                yield from _compared(node, tree, path)
            case ast.Expr(value=value):
                yield from _alone(value, tree)
            case ast.Assert(test=ast.Tuple(elts=[tested, *_]) as given):
                message = "a tuple is always true: the brackets make one of what is tested and its message"
                yield _Fault(given, message, ", ".join(map(ast.unparse, given.elts)) if tested else None)
            case ast.For(iter=through, target=target):
                yield from _letters(through, target, tree, path)
            case ast.ListComp(generators=parts) | ast.GeneratorExp(generators=parts):
                for part in parts:
                    yield from _letters(part.iter, part.target, tree, path)


def _alternatives(test: ast.expr) -> Iterator[_Fault]:
    """Yield texts that are no comparison of their own, behind one, and alternatives of texts in a comparison."""
    match test:
        case ast.BoolOp(op=ast.Or(), values=[ast.Compare(left=left, ops=[ast.Eq() as sign]), *others]):
            pass
        case ast.BoolOp(values=values):
            for value in values:
                yield from _alternatives(value)
            return
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            yield from _alternatives(operand)
            return
        case ast.Compare(
            left=left, ops=[ast.Eq() | ast.NotEq() as sign], comparators=[ast.BoolOp() as other]
        ):
            if all(isinstance(item, ast.Constant) for item in other.values):
                word = "in" if isinstance(sign, ast.Eq) else "not in"
                texts = ", ".join(map(ast.unparse, other.values))
                message = f"{ast.unparse(other)} is one of both, always the same: the other is never compared"
                yield _Fault(test, message, f"{ast.unparse(left)} {word} ({texts})")
            return
        case _:
            return
    for value in others:
        if isinstance(value, ast.Constant) and isinstance(value.value, str) and value.value:
            written = ast.unparse(value)
            message = f"{written} is compared with nothing, and always true"
            yield _Fault(value, message, f"{ast.unparse(left)} == {written}")


def _compared(node: ast.Compare, tree: Tree, path: str) -> Iterator[_Fault]:
    match node:
        case ast.Compare(
            left=left, ops=[ast.Is() | ast.IsNot() as sign], comparators=[ast.Constant() as other]
        ):
            if isinstance(other.value, str | int | float) and not isinstance(other.value, bool):
                word = "==" if isinstance(sign, ast.Is) else "!="
                meant = f"{ast.unparse(left)} {word} {ast.unparse(other)}"
                yield _Fault(node, "`is` asks for the very same object, which equal texts need not be", meant)
        case ast.Compare(ops=[ast.In() | ast.NotIn()], comparators=[other]):
            text = _bracketed(other, tree, path)
            if (
                text is not None
                and not isinstance(node.left, ast.Constant)
                and not _is_meant(text, node.left)
            ):
                message = f"{ast.unparse(text)} in brackets is a text, of which any part is in it: a comma makes more"
                yield _Fault(text, message, f"{ast.unparse(text)},")


def _bracketed(node: ast.expr, tree: Tree, path: str) -> ast.Constant | None:
    """Return the text that an expression is, where brackets around it suggest several."""
    known = tree.meaning(node)
    if not isinstance(known, ast.Constant) or not isinstance(known.value, str) or not known.value:
        return None
    span = node_span(path, known, quotes=True)
    if span.line != span.end_line or span.column == 1:
        return None
    wide = replace(span, column=span.column - 1, end_column=span.end_column + 1)
    around = text_at(path, wide)
    return known if around[:1] == "(" and around[-1:] == ")" else None


def _is_meant(text: ast.Constant, each: ast.expr) -> bool:
    """Return whether a text may well be meant as it is: a sentence, or letters that are looked at one by one."""
    written = str(text.value)
    codes = [ord(letter) for letter in written]
    is_row = codes == list(range(codes[0], codes[0] + len(codes))) or written.lower() in _ONE_BY_ONE
    match each:
        case ast.Name(id=name) | ast.Attribute(attr=name):
            is_of_one = _OF_ONE.fullmatch(name.lower()) is not None
        case _:  # `name[0]`, `name[-1]`
            is_of_one = isinstance(each, ast.Subscript) and _is_number(each.slice)
    return (
        is_row
        or is_of_one
        or any(letter.isspace() for letter in written)
        or not any(map(str.isalnum, written))
    )


def _is_number(node: ast.expr) -> bool:
    given = node.operand if isinstance(node, ast.UnaryOp) else node
    return isinstance(given, ast.Constant) and isinstance(given.value, int)


def _letters(through: ast.expr, each: ast.expr, tree: Tree, path: str) -> Iterator[_Fault]:
    """Yield a text in brackets that a loop goes through letter by letter."""
    text = _bracketed(through, tree, path)
    if text is not None and called_by(through) is None and not _is_meant(text, each):
        message = f"{_LETTERS}{ast.unparse(text)}: a comma makes a tuple"
        yield _Fault(text, message, f"{ast.unparse(text)},")


def _alone(value: ast.expr, tree: Tree) -> Iterator[_Fault]:
    """Yield statements that compare, or make another text, and do nothing with it."""
    match value:
        case ast.Compare(left=ast.Name() | ast.Attribute() | ast.Subscript() as left, ops=[ast.Eq()]):
            meant = f"{ast.unparse(left)} = {ast.unparse(value.comparators[0])}"
            yield _Fault(value, "what is compared here is used for nothing: one sign sets a value", meant)
        case ast.Call(func=ast.Attribute(value=ast.Name() as held, attr=attr)) if attr in METHODS_OF_TEXTS:
            known = tree.meaning(held)
            is_text = isinstance(known, ast.Constant) and isinstance(known.value, str)
            if is_text or isinstance(known, ast.JoinedStr) or called_by(known) in _TEXTS:
                message = f"{attr} returns another text, and leaves '{held.id}' as it is"
                yield _Fault(value, message, f"{held.id} = {ast.unparse(value)}")
