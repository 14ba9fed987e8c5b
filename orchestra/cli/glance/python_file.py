"""A glance at a launch file in Python: calls of `DeclareLaunchArgument` and `IncludeLaunchDescription` in its text."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from orchestra.cli.glance.expressions import Expressions, callee, keyword
from orchestra.cli.glance.model import Glance, SeenArgument, SeenInclude

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.cli.glance.model import Places

_SOURCES = frozenset(
    f"{language}LaunchDescriptionSource" for language in ("Python", "XML", "YAML", "Any", "Frontend")
)


def glance(text: str, places: Places) -> Glance:
    """Return what the text shows. Raises `SyntaxError`, `ValueError` for null bytes, `RecursionError`."""
    tree = ast.parse(text)
    expressions = Expressions(tree, places)
    found = list(_calls(tree, expressions, conditional=False))
    return Glance(
        tuple(item for item in found if isinstance(item, SeenArgument)),
        tuple(item for item in found if isinstance(item, SeenInclude)),
    )


def _calls(
    node: ast.AST, expressions: Expressions, *, conditional: bool
) -> Iterator[SeenArgument | SeenInclude]:
    """Yield what the calls in a tree declare and include, whatever function they stand in."""
    if isinstance(node, ast.Call):
        conditional |= keyword(node, "condition") is not None
        name = expressions.original(callee(node))
        if name == "DeclareLaunchArgument":
            yield from _argument(node, expressions, conditional=conditional)
            return
        if name == "IncludeLaunchDescription":
            yield from _include(node, expressions, conditional=conditional)
            return
    elif isinstance(node, ast.If | ast.IfExp):
        conditional = True
    for values in _rounds(node, expressions):
        with expressions.bound(values):
            for child in ast.iter_child_nodes(node):
                yield from _calls(child, expressions, conditional=conditional)


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
