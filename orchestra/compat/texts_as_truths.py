"""Texts of launch arguments that code asks whether they are true, or compares with what no text is equal to.

`'false'` is true for Python. A text that may be empty is asked for that with good reason, so only that of an argument
is told of which the file says that it is a truth value.
"""

from __future__ import annotations

import ast
from functools import lru_cache
from typing import TYPE_CHECKING, Final

from orchestra.compat.forms_meant import MEANT_FALSE, MEANT_TRUE
from orchestra.compat.performed_texts import is_changed, known_of, performed
from orchestra.compat.rewritten import Rewritten
from orchestra.compat.scopes import decided_by
from orchestra.compat.source_text import text_at
from orchestra.compat.syntax_trees import node_span
from orchestra.errors import Code
from orchestra.location import Location
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.compat.performed_texts import Known
    from orchestra.compat.syntax_trees import Tree
    from orchestra.errors import Problems
    from orchestra.location import Span

_EQUAL: Final = (ast.Eq, ast.NotEq)
_SAME: Final = (ast.Is, ast.IsNot)


def tell_truths(path: str, tree: Tree, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Warn of such texts in a file."""
    compared = _compared_names(tree)
    for node in tree.nodes:
        for tested in (leaf for test in decided_by(node) for leaf in _leaves(test)):
            if (
                isinstance(tested, ast.Name)
                and (tested.id, next(tree.functions_around(tested), None)) in compared
            ):
                continue  # whether it is empty, before it is compared
            told = _always_true(tested, tree, text_at(path, node_span(path, tested, quotes=True)))
            if told is not None:
                at = Location(node_span(path, tested, quotes=True), chain)
                problems.warning(Code.IMPOSSIBLE_CONDITION, told[0], at, suggestion=Rewritten(told[1]))
        if isinstance(node, ast.Compare) and len(node.ops) == 1:
            never = _never_equal(node, tree)
            if never is not None:
                at = Location(node_span(path, never[1], quotes=True), chain)
                problems.warning(Code.IMPOSSIBLE_CONDITION, never[0], at, suggestion=never[2])


def _compared_names(tree: Tree) -> set[tuple[str, object]]:
    """Return the names that code compares with texts, each with the function that does."""
    return {
        (side.id, next(tree.functions_around(side), None))
        for node in tree.nodes
        if isinstance(node, ast.Compare)
        for side in (node.left, *node.comparators)
        if isinstance(side, ast.Name)
    }


def _leaves(test: ast.expr) -> Iterator[ast.expr]:
    """Yield what is asked whether it is true, without what `and`, `or` and `not` make of it."""
    match test:
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            yield from _leaves(operand)
        case ast.BoolOp(values=values):
            compared = {ast.dump(item.left) for item in ast.walk(test) if isinstance(item, ast.Compare)}
            for value in values:
                if ast.dump(value) not in compared:  # `a and a == 'x'`
                    yield from _leaves(value)
        case ast.Name() | ast.Call() | ast.Subscript():
            yield test


def _always_true(tested: ast.expr, tree: Tree, source: str) -> tuple[str, str] | None:
    """Return what to say of a text that is asked whether it is true, and the comparison that was meant."""
    name = performed(tested, tree)
    known = known_of(name, tree) if name else None
    value = None if known is None else _truth(known)
    if value is None:
        return None
    message = f"the text of '{name}' counts as true, even {_other(value)!r}: it is compared with 'true'"
    if known is not None and known.choices is not None:
        true = next((item for item in known.choices if item.lower() in MEANT_TRUE), "true")
        return message, f"{source} == {true!r}"
    is_large = value != value.lower() and not is_changed(tested, tree)
    return message, f"{source}.lower() == 'true'" if is_large else f"{source} == {_true(value)!r}"


def _truth(known: Known) -> str | None:
    """Return a text that a launch argument has if it is a truth value, None if it is none. 1 may be a number."""
    values = known.choices or ((known.default,) if known.default is not None else ())
    is_one = values and all(value.lower() in MEANT_TRUE | MEANT_FALSE for value in values)
    if known.choices is None and any(value.isdigit() for value in values):
        return None
    return values[0] if is_one and values else None


def _true(value: str) -> str:
    """Return the word for true that goes with a word for it or for its opposite."""
    return {"0": "1", "1": "1", "no": "yes", "yes": "yes", "off": "on", "on": "on"}.get(value.lower(), "true")


def _other(value: str) -> str:
    return {"true": "false", "True": "False"}.get(value, value)


def _never_equal(node: ast.Compare, tree: Tree) -> tuple[str, ast.expr, str | None] | None:
    """Return what to say of a comparison that always comes out alike, where, and what should stand there."""
    sides = [(node.left, node.comparators[0]), (node.comparators[0], node.left)]
    for text, other in sides:
        if (
            isinstance(node.ops[0], _EQUAL + _SAME)
            and isinstance(other, ast.Constant)
            and other.value is not None
        ):
            name = performed(text, tree)
            if name is not None and (other.value is not Ellipsis):
                return _compared(node, (name, is_changed(text, tree)), other, tree)
    return None


def _is_asked_for(text: str, tree: Tree) -> bool:
    """Return whether code compares something with a text, too."""
    return text in _asked_for(tree)


@lru_cache(maxsize=1)
def _asked_for(tree: Tree) -> frozenset[str]:
    return frozenset(
        side.value
        for node in tree.nodes
        if isinstance(node, ast.Compare)
        for part in (node.left, *node.comparators)
        for side in (part.elts if isinstance(part, ast.List | ast.Set | ast.Tuple) else (part,))
        if isinstance(side, ast.Constant) and isinstance(side.value, str)
    )


def _compared(
    node: ast.Compare, text: tuple[str, bool], other: ast.Constant, tree: Tree
) -> tuple[str, ast.expr, str | None] | None:
    value, known = other.value, known_of(text[0], tree)
    if not isinstance(value, str):
        true = next(
            (item for item in (*(known.choices or ()), known.default) if item and item.lower() == "true"),
            None,
        )
        plain = (true or "true") if value is True else str(value).lower()
        message = f"a text is never equal to {value!r}: it may be {plain!r}"
        if isinstance(node.ops[0], _SAME):
            sign = "==" if isinstance(node.ops[0], ast.Is) else "!="
            return message, node, Rewritten(f"{ast.unparse(node.left)} {sign} {plain!r}")
        return message, other, Rewritten(repr(plain))
    if text[1] or not text[0]:
        return None
    if known.choices is not None and value not in known.choices:
        meant = nearest(value, known.choices)
        return f"'{text[0]}' is {', '.join(known.choices)}: it is never {value!r}", other, meant
    default = known.default or ""
    is_other = default != value and default.lower() == value.lower() and bool(default)
    if known.choices is None and is_other and not _is_asked_for(default, tree):
        return f"'{text[0]}' has the default {default!r}: {value!r} is another text", other, default
    return None
