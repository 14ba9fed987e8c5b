"""`group`: actions in a scope of their own."""

from __future__ import annotations

from pydantic import Field

from orchestra.description.entity import Action
from orchestra.description.fields import Flag
from orchestra.description.nested import Children, ForEach
from orchestra.description.parts import Pair


class Group(Action):
    """Actions whose variables, environment, namespace, parameters and remappings end with the group."""

    scoped: Flag | None = Field(
        default=None, description="Whether what is set inside ends with the group (default)."
    )
    forwarding: Flag | None = Field(
        default=None, description="Whether what is set outside is seen inside (default)."
    )
    keep: tuple[Pair, ...] = Field(default=(), description="Variables to set inside.")
    for_each: ForEach | None = Field(default=None, description="Carry the group out once per value.")
    children: Children = Field(description="The actions of the group.")
