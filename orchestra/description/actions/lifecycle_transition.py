"""Takes lifecycle nodes through transitions (a word of Python launch files alone)."""

from __future__ import annotations

from orchestra.description.entity import Action
from orchestra.description.fields import Integer, Text
from orchestra.description.model import field


class LifecycleTransition(Action):
    """Take lifecycle nodes of this launch through transitions, each when the one before has reached its goal."""

    node: tuple[Text, ...] = field(description="Full names; the slash in front may be left out.")
    transition: tuple[Integer, ...] = field(description="Ids of lifecycle_msgs/msg/Transition, in order.")
