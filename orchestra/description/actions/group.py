"""`group`: actions in a scope of their own."""

from __future__ import annotations

from orchestra.description.entity import Action
from orchestra.description.fields import Flag
from orchestra.description.model import field
from orchestra.description.nested import Children, ForEach
from orchestra.description.parts import Pair


class Group(Action):
    """Actions whose variables, environment, namespace, parameters and remappings end with the group."""

    scoped: Flag | None = field(
        default=None, description="Whether what is set inside ends with the group (default)."
    )
    forwarding: Flag | None = field(
        default=None, description="Whether what is set outside is seen inside (default)."
    )
    keep: tuple[Pair, ...] = field(default=(), description="Variables to set inside.")
    for_each: ForEach | None = field(default=None, description="Carry the group out once per value.")
    children: Children = field(description="The actions of the group.")
