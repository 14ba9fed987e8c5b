"""`set_parameter`: sets a parameter of every node."""

from __future__ import annotations

from orchestra.description.entity import Action
from orchestra.description.fields import AnyValue, Text


class SetParameter(Action):
    """Set a parameter of every node that follows in this scope."""

    name: Text
    value: AnyValue
