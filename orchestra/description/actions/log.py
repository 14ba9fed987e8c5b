"""`log`: tells the user something."""

from __future__ import annotations

from orchestra.description.entity import Action
from orchestra.description.fields import Text


class Log(Action):
    """Print a message when the run starts, or when the timer around it goes off."""

    message: Text
