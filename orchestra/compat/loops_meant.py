"""What was meant by loops, and by lists that are added to, that Python refuses: `for i in 3`, `nodes.extend(node)`."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Final

from orchestra.compat.explanation import Explanation
from orchestra.compat.rewritten import Rewritten
from orchestra.compat.syntax_trees import called_by, node_span, tree_of
from orchestra.fields import replace

if TYPE_CHECKING:
    from orchestra.compat.place import Place
    from orchestra.compat.syntax_trees import Tree
    from orchestra.location import Span

_LISTS: Final = (ast.List, ast.ListComp, ast.Tuple)
_PAIR: Final = 2
_MOST: Final = 100  # characters: what is longer is read better in the message alone


def explained(error: BaseException, place: Place) -> Explanation | None:
    """Return what to do about a loop over what is none, values that are not as many as names, a list and no list."""
    tree, told = tree_of(place.file), str(error)
    node = None if tree is None else tree.expression(place.file, place.span)
    found: tuple[ast.expr, str | None] | None = None
    if tree is None:
        return None
    if "unpack" in told:
        found = _unpacked(node, tree)
    elif "is not iterable" in told:
        if (
            isinstance(node, ast.Call)
            and called_by(node) == "extend"
            and isinstance(node.func, ast.Attribute)
        ):
            span = _name_of(node_span(place.file, node.func), node.func.attr)
            return Explanation(f"{type(error).__name__}: {error}", span=span, suggestion="append")
        found = _looped(node, place.span, tree) or _added(place.span, tree)
    elif "cannot be interpreted as an integer" in told:
        found = _counted(node, tree)
    elif 'can only concatenate list (not "' in told and isinstance(node, ast.BinOp):
        is_tuple = '"tuple"' in told
        found = (node.right, None if is_tuple else f"[{ast.unparse(node.right)}]")
    elif "unsupported operand" in told:
        found = _operands(node, told, tree)
    if found is None:
        return None
    meant = found[1] if found[1] is not None and len(found[1]) <= _MOST else None
    return Explanation(
        f"{type(error).__name__}: {error}",
        span=node_span(place.file, found[0], quotes=True),
        suggestion=None if meant is None else Rewritten(meant),
    )


def _name_of(span: Span, name: str) -> Span:
    return replace(span, line=span.end_line, column=span.end_column - len(name))


def _loops(tree: Tree) -> list[tuple[ast.expr, ast.expr, ast.AST]]:
    """Return what loops go through by, and what they go through, with the statement or expression that does."""
    found: list[tuple[ast.expr, ast.expr, ast.AST]] = []
    for node in tree.nodes:
        match node:
            case ast.For(target=target, iter=through):
                found.append((target, through, node))
            case (
                ast.ListComp(generators=parts)
                | ast.GeneratorExp(generators=parts)
                | ast.SetComp(generators=parts)
                | ast.DictComp(generators=parts)
            ):
                found += [(part.target, part.iter, node) for part in parts]
    return found


def _unpacked(node: ast.expr | None, tree: Tree) -> tuple[ast.expr, str | None] | None:
    """Return what gives other values than a loop has names, or the one item that does."""
    for target, through, _ in _loops(tree):
        if target is not node or not isinstance(target, ast.Tuple):
            continue
        known, count = tree.meaning(through), len(target.elts)
        match known:
            case ast.Dict() | ast.DictComp() | ast.Call(func=ast.Name(id="dict")) if count == _PAIR:
                return through, f"{ast.unparse(through)}.items()"
            case ast.List(elts=items) | ast.Tuple(elts=items):
                others = [item for item in items if not isinstance(item, _LISTS) or _length(item) != count]
                if others and len(others) < len(items):
                    return others[0], None
                if count == _PAIR and not any(isinstance(item, _LISTS) for item in items):
                    return through, f"enumerate({ast.unparse(through)})"
    return None


def _length(item: ast.expr) -> int:
    return len(item.elts) if isinstance(item, ast.List | ast.Tuple) else -1


def _looped(node: ast.expr | None, span: Span, tree: Tree) -> tuple[ast.expr, str | None] | None:
    """Return the number that a loop goes through, and the range that was meant."""
    for _, through, loop in _loops(tree):
        is_header = node is None and isinstance(loop, ast.For) and loop.lineno == span.line
        if is_header or (node is not None and (node is through or node is loop)):
            known = tree.meaning(through)
            if isinstance(known, ast.Constant) and type(known.value) is int:
                return through, f"range({ast.unparse(through)})"
            if called_by(known) == "len":
                return through, f"range({ast.unparse(through)})"
    return None


def _added(span: Span, tree: Tree) -> tuple[ast.expr, str | None] | None:
    """Return what is added to a list by its sign without the brackets of one."""
    for node in tree.nodes:
        if isinstance(node, ast.AugAssign) and node.lineno <= span.line <= (node.end_lineno or 0):
            return node.value, f"[{ast.unparse(node.value)}]"
    return None


def _counted(node: ast.expr | None, tree: Tree) -> tuple[ast.expr, str | None] | None:
    """Return the list that a range is asked for, and its length."""
    given = node.args if isinstance(node, ast.Call) and called_by(node) == "range" else []
    lists = [item for item in given if isinstance(tree.meaning(item), _LISTS)]
    return (lists[0], f"len({ast.unparse(lists[0])})") if lists else None


def _operands(node: ast.expr | None, told: str, tree: Tree) -> tuple[ast.expr, str | None] | None:
    """Return what is put together by the sign of another kind: paths, texts and dictionaries."""
    if not isinstance(node, ast.BinOp):
        return None
    whole: ast.expr = node
    for around in tree.nodes[::-1]:
        if isinstance(around, ast.BinOp) and around.left is whole and type(around.op) is type(node.op):
            whole = around
    parts = _parts(whole, type(node.op))
    if "/: 'str'" in told:
        return whole, f"os.path.join({', '.join(map(ast.unparse, parts))})"
    if "+: 'PosixPath' and 'str'" in told:
        texts = [
            ast.Constant(part.value.strip("/"))
            if isinstance(part, ast.Constant) and isinstance(part.value, str)
            else part
            for part in parts
        ]
        return whole, " / ".join(map(ast.unparse, texts))
    return (whole, " | ".join(map(ast.unparse, parts))) if "+: 'dict' and 'dict'" in told else None


def _parts(node: ast.expr, sign: type[ast.operator]) -> list[ast.expr]:
    if isinstance(node, ast.BinOp) and isinstance(node.op, sign):
        return [*_parts(node.left, sign), node.right]
    return [node]
