"""`log`: tells the user something."""

from __future__ import annotations

from typing import Annotated

from orchestra.description.entity import Action
from orchestra.description.fields import Text, word, worded
from orchestra.description.marks import Plain
from orchestra.description.model import field
from orchestra.description.text import Template

LEVELS = ("debug", "info", "warning", "error")


class Log(Action):
    """Print a message when the run starts, or when the timer around it goes off."""

    message: Text = field(description="The text; may have substitutions.")
    level: Annotated[Template, Plain(word(*LEVELS)), worded(*LEVELS)] | None = field(
        default=None, description="How much it matters; `info` where absent."
    )
