"""`let`: sets a variable."""

from __future__ import annotations

from orchestra.description.entity import Action
from orchestra.description.fields import Text


class Let(Action):
    """Set the variable that `$(var NAME)` reads."""

    name: Text
    value: Text
