"""Comparisons of two texts that are both written there: the name of an argument stands in place of its value."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from orchestra.compat.literals import call_at
from orchestra.compat.remarks import remark
from orchestra.compat.rewritten import Rewritten
from orchestra.compat.syntax_trees import node_span, tree_of
from orchestra.errors import Code

if TYPE_CHECKING:
    from orchestra.compat.place import Place


def tell_constant_sides(place: Place, name: str) -> None:
    """Warn of a comparison at a place whose two sides are texts of the code, one of them the name of an argument."""
    call, tree = call_at(place), tree_of(place.file)
    sides = [] if call is None else [*call.args, *(word.value for word in call.keywords)]
    declared = set() if tree is None else set(tree.declared())
    for side in sides:
        is_text = isinstance(side, ast.Constant) and side.value in declared
        if is_text and all(isinstance(other, ast.Constant) for other in sides):
            text = ast.unparse(side)
            message = (
                f"{name} compares the texts as they are written: LaunchConfiguration({text}) has the value"
            )
            span, meant = node_span(place.file, side, quotes=True), Rewritten(f"LaunchConfiguration({text})")
            remark(Code.IMPOSSIBLE_CONDITION, message, span, suggestion=meant)
            return
