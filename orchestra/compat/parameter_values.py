"""Values of parameters as Python writes them, where those that were meant are known as YAML has them."""

from __future__ import annotations

import ast
import json
import re
from typing import TYPE_CHECKING, Final

from orchestra.compat.literals import argument
from orchestra.compat.rewritten import Rewritten
from orchestra.compat.syntax_trees import tree_of

if TYPE_CHECKING:
    from orchestra.compat.place import Argument
    from orchestra.location import Span

_NO_JSON: Final = {".inf": "float('inf')", "-.inf": "float('-inf')", ".nan": "float('nan')"}
_ASSIGNED: Final = re.compile(r"(?:[\w/]+:(?!=))?([A-Za-z_][\w.]*)\s*(?::=|=|:\s)\s*(.+)")
_LITERALS: Final = ast.Constant | ast.List | ast.Tuple | ast.UnaryOp


def value_meant(span: Argument, meant: str) -> tuple[Span, Rewritten] | None:
    """Return where a parameter of a node is written as a value, and the one that was meant; None where it is not.

    A name of such a value gives way to it. What else stands for one, as the default of an argument, remains a text.
    """
    if span.path[:1] != ("parameters",):
        return None
    found = argument(span.place, span.path)
    tree = tree_of(found.file)
    node = found.node if found.node is None or tree is None else tree.meaning(found.node)
    return (found.whole, _written(meant)) if isinstance(node, _LITERALS) else None


def _written(meant: str) -> Rewritten:
    """Return a value of YAML, of which numbers, texts, and lists are those of JSON, but for a few numbers."""
    try:
        return Rewritten(repr(json.loads(meant)))
    except ValueError:
        return Rewritten(_NO_JSON.get(meant, meant))


def assigned(text: str) -> str | None:
    """Return the dictionary that a text is written for which gives a parameter: `rate:=5`, `rate=5` or `rate: 5`."""
    found = _ASSIGNED.fullmatch(text)
    if found is None or found[2].endswith((".yaml", ".yml")):
        return None
    value = {"true": "True", "false": "False"}.get(found[2].lower(), found[2])
    try:
        plain = ast.literal_eval(value)
    except (ValueError, SyntaxError):
        plain = found[2]
    return f"{{{found[1]!r}: {plain!r}}}"
