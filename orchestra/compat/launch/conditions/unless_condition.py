"""`UnlessCondition`: holds where a text comes to false."""

from __future__ import annotations

from orchestra.compat.launch.conditions.if_condition import IfCondition


class UnlessCondition(IfCondition):
    """Holds where the substitutions come to false."""

    _field = "unless"
    _wanted = False
