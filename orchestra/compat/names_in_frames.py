"""What names in the user's code stand for while it runs."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from types import FrameType


def value_of(expression: ast.expr, frame: FrameType) -> Any:
    """Return what a name, an attribute of one, or an entry of it stands for in a frame; None for anything else.

    `super().__init__` stands for the class of ours that the object in construction derives from.
    """
    if ast.unparse(expression) == "super().__init__":
        made = frame.f_locals.get(frame.f_code.co_varnames[0])
        kinds = type(made).__mro__
        return next((kind for kind in kinds if kind.__module__.startswith("orchestra.compat.")), None)
    if isinstance(expression, ast.Attribute):
        return getattr(value_of(expression.value, frame), expression.attr, None)
    if isinstance(expression, ast.Subscript) and isinstance(expression.slice, ast.Constant):
        held, key = value_of(expression.value, frame), expression.slice.value
        return held.get(key) if type(held) is dict else None
    if not isinstance(expression, ast.Name):
        return None
    return frame.f_locals.get(expression.id, frame.f_globals.get(expression.id))
