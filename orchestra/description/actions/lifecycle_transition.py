"""Takes lifecycle nodes through transitions (a word of Python launch files alone)."""

from __future__ import annotations

from pydantic import Field

from orchestra.description.entity import Action
from orchestra.description.fields import Integer, Text


class LifecycleTransition(Action):
    """Take lifecycle nodes of this launch through transitions, each when the one before has reached its goal."""

    node: tuple[Text, ...] = Field(description="Full names; the slash in front may be left out.")
    transition: tuple[Integer, ...] = Field(description="Ids of lifecycle_msgs/msg/Transition, in order.")
