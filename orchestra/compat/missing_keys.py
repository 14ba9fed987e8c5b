"""Keys that a mapping does not have: the one that was meant."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from typing import TYPE_CHECKING

from orchestra.compat.explanation import Explanation
from orchestra.compat.names_in_frames import value_of
from orchestra.compat.syntax_trees import node_span, tree_of
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from types import FrameType

    from orchestra.compat.place import Place


def explained(error: KeyError, frame: FrameType, place: Place) -> Explanation | None:
    """Explain a key that is written in the code; None where it comes from elsewhere."""
    tree = tree_of(place.file)
    node = None if tree is None else tree.expression(place.file, place.span)
    if not isinstance(node, ast.Subscript) or not isinstance(node.slice, ast.Constant):
        return None
    mapping, key = value_of(node.value, frame), node.slice.value
    known = [name for name in mapping if isinstance(name, str)] if isinstance(mapping, Mapping) else []
    if not isinstance(key, str) or error.args[:1] != (key,):
        return None
    meant = nearest(key, known)
    message = f"there is no key {key!r} in {ast.unparse(node.value)}"
    return Explanation(message, span=node_span(place.file, node.slice), suggestion=meant)
