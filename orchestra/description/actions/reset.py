"""`reset`: forgets variables."""

from __future__ import annotations

from pydantic import Field

from orchestra.description.entity import Action
from orchestra.description.parts import Pair


class Reset(Action):
    """Forget all variables, the pushed namespace, and the parameters and remappings of all nodes."""

    keep: tuple[Pair, ...] = Field(default=(), description="Variables to set afterwards.")
