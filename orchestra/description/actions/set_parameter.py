"""`set_parameter`: sets a parameter of every node."""

from __future__ import annotations

from orchestra.description.conflict import Conflict
from orchestra.description.entity import Action
from orchestra.description.fields import AnyValue, Text
from orchestra.description.model import field
from orchestra.description.parts import Param, TypeWord


class SetParameter(Action):
    """Set a parameter of every node that follows in this scope."""

    name: Text = field(description="Name of the parameter, or of the level above `param`.")
    value: AnyValue | None = field(default=None, description="A scalar or a list of scalars of one type.")
    type: TypeWord | None = field(
        default=None, description="Read the value as this type instead of by its looks."
    )
    param: tuple[Param, ...] | None = field(default=None, description="Nested parameters.")

    def conflict(self) -> Conflict | None:
        """Return what keeps this from being a value or a group of values."""
        if (self.value is None) == (self.param is None):
            too_many = () if self.value is None else ("value", "param")
            return Conflict("`set_parameter` has one of `value` and `param`", too_many)
        if self.type is not None and self.value is None:
            return Conflict("`type` goes with `value`", ("type",))
        return super().conflict()
