"""`let`: sets a variable."""

from __future__ import annotations

from orchestra.description.entity import Action
from orchestra.description.fields import Text
from orchestra.description.model import field


class Let(Action):
    """Set the variable that `$(var NAME)` reads."""

    name: Text = field(description="Name of the variable.")
    value: Text = field(description="Its value from here on.")
