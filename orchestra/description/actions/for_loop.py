"""`for` and `for_each` (newer ROS releases): actions that are carried out again and again."""

from __future__ import annotations

from orchestra.description.entity import Action
from orchestra.description.fields import Literal, Text
from orchestra.description.model import field
from orchestra.description.nested import Children


class ForLoop(Action):
    """Actions to carry out so many times; `$(index NAME)` in them is 0 the first time."""

    len: Text = field(description="How many times; a whole number.")
    name: Literal = field(description="The name of the index.")
    children: Children = field(description="The actions.")


class ForEachLoop(Action):
    """Actions to carry out once per mapping; `$(for-var KEY)` in them is what stands under a key."""

    values: Text = field(
        description="Mappings in YAML with semicolons between them: `{robot: a};{robot: b}`."
    )
    children: Children = field(description="The actions.")
