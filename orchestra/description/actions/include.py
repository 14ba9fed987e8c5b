"""`include`: another launch file."""

from __future__ import annotations

from pydantic import Field

from orchestra.description.entity import Action
from orchestra.description.fields import Flag, Text
from orchestra.description.nested import ForEach
from orchestra.description.parts import DependsOn, Pair


class Include(Action):
    """The actions of another launch file, with arguments."""

    file: Text = Field(description="Path, relative to the including file.")
    arg: tuple[Pair, ...] = Field(default=(), description="Arguments for the file.")
    let: tuple[Pair, ...] = Field(
        default=(), description="The same as `arg`, as newer ROS releases spell it."
    )
    for_each: ForEach | None = Field(default=None, description="Include the file once per value.")
    scoped: Flag | None = Field(default=None, description="Whether what the file sets ends with it.")
    label: Text | None = Field(default=None, description="Name for all processes inside, for `depends_on`.")
    depends_on: tuple[DependsOn, ...] = Field(default=(), description="What every process inside waits for.")
