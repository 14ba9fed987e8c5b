"""`shutdown`: ends the run."""

from __future__ import annotations

from pydantic import Field

from orchestra.description.entity import Action
from orchestra.description.fields import Text


class Shutdown(Action):
    """End the run."""

    reason: Text | None = Field(default=None, description="Why, for the log.")
