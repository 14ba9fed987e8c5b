"""`shutdown`: ends the run."""

from __future__ import annotations

from orchestra.description.entity import Action
from orchestra.description.fields import Text
from orchestra.description.model import field


class Shutdown(Action):
    """End the run."""

    reason: Text | None = field(default=None, description="Why, for the log.")
