"""Calls of one function that are surely carried out one after the other, as the code around them tells."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from orchestra.compat.syntax_trees import called_by, node_span, tree_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.compat.place import Place
    from orchestra.compat.syntax_trees import Tree
    from orchestra.location import Span


def is_declared_twice(file: str, name: str) -> bool:
    """Return whether a launch argument is declared twice in one list, or by statements of one block.

    Lists that are put together, of which the first declaration counts, are no mistake.
    """
    tree = tree_of(file)
    if tree is None:
        return False
    calls = [node for node in tree.nodes if _declares(node, name)]
    return any(sum(item in calls for item in block) > 1 for block in _blocks(tree))


def second_use(made: Place) -> Span | None:
    """Return where an action stands a second time among others, by the name of the variable that it is set to."""
    tree = tree_of(made.file)
    node = None if tree is None else tree.expression(made.file, made.span)
    if tree is None or node is None:
        return None
    names = [
        item.targets[0].id
        for item in tree.nodes
        if isinstance(item, ast.Assign) and item.value is node and isinstance(item.targets[0], ast.Name)
    ]
    uses = [use for use in _used(tree) if isinstance(use, ast.Name) and use.id in names]
    uses.sort(key=lambda use: (use.lineno, use.col_offset))
    return node_span(made.file, uses[1]) if len(uses) > 1 else None


def _declares(node: ast.AST, name: str) -> bool:
    if not isinstance(node, ast.Call) or called_by(node) != "DeclareLaunchArgument":
        return False
    given = [*node.args[:1], *(word.value for word in node.keywords if word.arg == "name")]
    is_conditional = any(word.arg in ("condition", None) for word in node.keywords)
    return not is_conditional and any(isinstance(word, ast.Constant) and word.value == name for word in given)


def _blocks(tree: Tree) -> Iterator[Sequence[ast.AST]]:
    """Yield the items of lists, and what the simple statements of blocks make or add."""
    for node in tree.nodes:
        if isinstance(node, ast.List):
            yield node.elts
        for part in ("body", "orelse"):
            block = getattr(node, part, None)
            if isinstance(block, list):
                yield [made for item in block for made in _made(item)]


def _made(statement: ast.AST) -> Iterator[ast.expr]:
    match statement:
        case ast.Expr(value=ast.Call(args=[made])) | ast.Assign(value=made):
            yield made


def _used(tree: Tree) -> Iterator[ast.expr]:
    """Yield what stands as an action among others, or is added to a launch description; not what is repeated."""
    repeated = {
        child
        for node in tree.nodes
        if isinstance(node, ast.Call) and any(word.arg == "for_each" for word in node.keywords)
        for child in ast.walk(node)
    }
    for node in tree.nodes:
        match node:
            case ast.expr() if node in repeated:
                continue
            case ast.List(elts=items) | ast.Tuple(elts=items):
                yield from items
            case ast.Call(args=[item]) if called_by(node) in ("add_action", "add_entity", "append"):
                yield item
            case ast.keyword():
                continue
            case ast.Call(keywords=words):
                yield from (word.value for word in words if str(word.arg).startswith("on_"))
