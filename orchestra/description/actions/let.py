"""`let`: sets a variable."""

from __future__ import annotations

from pydantic import Field

from orchestra.description.entity import Action
from orchestra.description.fields import Text


class Let(Action):
    """Set the variable that `$(var NAME)` reads."""

    name: Text = Field(description="Name of the variable.")
    value: Text = Field(description="Its value from here on.")
