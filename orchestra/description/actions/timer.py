"""`timer`: actions after a while."""

from __future__ import annotations

from orchestra.description.entity import Action
from orchestra.description.fields import Flag, Seconds
from orchestra.description.model import field
from orchestra.description.nested import Children


class Timer(Action):
    """Actions to carry out some seconds after the run has started."""

    period: Seconds = field(description="Seconds from the start of the run.")
    cancel_on_shutdown: Flag | None = field(
        default=None, description="Whether a shutdown cancels it (default)."
    )
    children: Children = field(description="The actions.")
