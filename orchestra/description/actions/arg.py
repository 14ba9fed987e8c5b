"""`arg`: declares a launch argument."""

from __future__ import annotations

from pydantic import Field

from orchestra.description.entity import Action, Entity
from orchestra.description.fields import Literal, Text


class Choice(Entity):
    """One of the values that an argument may have."""

    value: Literal = Field(description="The value.")


class Arg(Action):
    """A launch argument, from here on visible as `$(var NAME)`."""

    name: Literal = Field(
        description="Name of the argument: `name:=value` on the command line, `$(var name)` here."
    )
    default: Text | None = Field(default=None, description="Value where the caller gives none.")
    description: Literal | None = Field(default=None, description="What it is for; shown by `--show-args`.")
    choice: tuple[Choice, ...] | None = Field(
        default=None, min_length=1, description="The values it may have, as XML writes them."
    )
    choices: tuple[Literal, ...] | None = Field(
        default=None, min_length=1, description="The values it may have."
    )
