"""A glance at a launch file in Python: calls of `DeclareLaunchArgument` and `IncludeLaunchDescription` in its text."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from orchestra.cli.glance.expressions import Expressions, callee, keyword
from orchestra.cli.glance.model import Glance, SeenArgument, SeenInclude

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.cli.glance.model import Places

_DECLARE, _INCLUDE = "DeclareLaunchArgument", "IncludeLaunchDescription"
_LEAVES = (ast.Constant, ast.Name, ast.expr_context, ast.operator, ast.alias)
_SOURCES = frozenset(
    f"{language}LaunchDescriptionSource" for language in ("Python", "XML", "YAML", "Any", "Frontend")
)


def glance(text: str, places: Places) -> Glance:
    """Return what the text shows. Raises `SyntaxError`, `ValueError` for null bytes, `RecursionError`."""
    tree = ast.parse(text)
    arguments: list[SeenArgument] = []
    includes: list[SeenInclude] = []
    expressions = Expressions(tree, places)
    for call, conditional in _calls(tree, expressions):
        if expressions.original(callee(call)) == _DECLARE:
            arguments += _argument(call, expressions, conditional=conditional)
        else:
            includes += _include(call, expressions, conditional=conditional)
    return Glance(tuple(arguments), tuple(includes))


def _calls(tree: ast.Module, expressions: Expressions) -> Iterator[tuple[ast.Call, bool]]:
    """Yield the calls that count, whatever function they stand in, and whether a condition is around them.

    While one is looked at, the names of the loops around it are bound.
    """
    waiting: list[tuple[ast.AST, bool, dict[str, ast.expr]]] = [(tree, False, {})]
    while waiting:
        node, conditional, bound = waiting.pop()
        if isinstance(node, ast.Call):
            conditional |= keyword(node, "condition") is not None
            if expressions.original(callee(node)) in (_DECLARE, _INCLUDE):
                with expressions.bound(bound):
                    yield node, conditional
                continue
        elif isinstance(node, ast.If | ast.IfExp):
            conditional = True
        children = [child for child in ast.iter_child_nodes(node) if not isinstance(child, _LEAVES)]
        with expressions.bound(bound):
            rounds = _rounds(node, expressions)
        for values in reversed(rounds):
            inner = {**bound, **values} if values else bound
            waiting += [(child, conditional, inner) for child in reversed(children)]


def _rounds(node: ast.AST, expressions: Expressions) -> list[dict[str, ast.expr]]:
    """Return the bindings with which a node is gone through: once without any, unless it is a loop that is known."""
    if isinstance(node, ast.For):
        return expressions.rounds(node.target, node.iter) or [{}]
    if isinstance(node, ast.ListComp | ast.GeneratorExp) and len(node.generators) == 1:
        generator = node.generators[0]
        return expressions.rounds(generator.target, generator.iter) or [{}]
    return [{}]


def _argument(call: ast.Call, expressions: Expressions, *, conditional: bool) -> Iterator[SeenArgument]:
    name = expressions.text(_given(call, 0, "name"))
    if name is None:
        return
    default = _given(call, None, "default_value")
    if isinstance(default, ast.Constant) and default.value is None:
        default = None
    value = expressions.text(default)
    written = value if value is not None or default is None else ast.unparse(default)
    choices = expressions.texts(_given(call, None, "choices")) or ()
    description = expressions.text(_given(call, None, "description"))
    yield SeenArgument(name, written, value is not None, choices, description, conditional)


def _include(call: ast.Call, expressions: Expressions, *, conditional: bool) -> Iterator[SeenInclude]:
    source = expressions.named(_given(call, 0, "launch_description_source"))
    if isinstance(source, ast.Call) and expressions.original(callee(source)) in _SOURCES:
        source = source.args[0] if source.args else None
    path = expressions.text(source)
    if path is not None:
        given = expressions.keys(_given(call, None, "launch_arguments"))
        yield SeenInclude(path, given, conditional)


def _given(call: ast.Call, position: int | None, name: str) -> ast.expr | None:
    if position is not None and len(call.args) > position:
        return call.args[position]
    return keyword(call, name)
