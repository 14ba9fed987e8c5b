"""`reset`: forgets variables."""

from __future__ import annotations

from orchestra.description.entity import Action
from orchestra.description.model import field
from orchestra.description.parts import Pair


class Reset(Action):
    """Forget all variables, the pushed namespace, and the parameters and remappings of all nodes."""

    keep: tuple[Pair, ...] = field(default=(), description="Variables to set afterwards.")
