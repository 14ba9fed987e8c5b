"""`include`: another launch file."""

from __future__ import annotations

from typing import Any, Literal, Self, TypeAlias

from pydantic import Field, PrivateAttr

from orchestra.description.entity import Action
from orchestra.description.fields import Flag, Text
from orchestra.description.nested import ForEach
from orchestra.description.parts import DependsOn, Pair

Language: TypeAlias = Literal["python", "xml", "yaml"]


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

    _language: Language | None = PrivateAttr(default=None)
    _source: Any = PrivateAttr(default=None)

    @property
    def language(self) -> Language | None:
        """What the file is read as, None: its name tells. Only Python code says it."""
        return self._language

    @property
    def source(self) -> Any:  # noqa: ANN401 - a source of a Python launch file
        """The object that has the launch description, which is then not read from the file, which may not exist."""
        return self._source

    def taken_from(self, *, language: Language | None, source: Any) -> Self:  # noqa: ANN401 - a source of a Python launch file
        """Set where Python code takes the description from; return the action."""
        self._language = language
        self._source = source
        return self
