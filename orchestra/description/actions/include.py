"""`include`: another launch file."""

from __future__ import annotations

from typing import Literal, Self, TypeAlias

from orchestra.description.entity import Action
from orchestra.description.fields import Flag, Text
from orchestra.description.model import field
from orchestra.description.nested import ForEach
from orchestra.description.parts import DependsOn, Pair

Language: TypeAlias = Literal["python", "xml", "yaml"]


class Include(Action):
    """The actions of another launch file, with arguments."""

    file: Text = field(description="Path, relative to the including file.")
    arg: tuple[Pair, ...] = field(default=(), description="Arguments for the file.")
    let: tuple[Pair, ...] = field(
        default=(), description="The same as `arg`, as newer ROS releases spell it."
    )
    for_each: ForEach | None = field(default=None, description="Include the file once per value.")
    scoped: Flag | None = field(default=None, description="Whether what the file sets ends with it.")
    label: Text | None = field(default=None, description="Name for all processes inside, for `depends_on`.")
    depends_on: tuple[DependsOn, ...] = field(default=(), description="What every process inside waits for.")

    @property
    def language(self) -> Language | None:
        """What the file is read as, None: its name tells. Only Python code says it."""
        return self._beside.get("language")

    def read_as(self, language: Language | None) -> Self:
        """Set what the file is read as; return the action."""
        self._beside["language"] = language
        return self

    @property
    def children(self) -> tuple[Action, ...] | None:
        """What is included where no file is. Only Python code says it."""
        return self._beside.get("children")

    def holding(self, children: tuple[Action, ...]) -> Self:
        """Set what is included instead of a file; return the action."""
        self._beside["children"] = children
        return self
