"""`shutdown`: ends the run."""

from __future__ import annotations

from orchestra.description.entity import Action
from orchestra.description.fields import Text


class Shutdown(Action):
    """End the run."""

    reason: Text | None = None
