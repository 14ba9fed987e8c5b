"""`arg`: declares a launch argument."""

from __future__ import annotations

from typing import Annotated

from orchestra.description.entity import Action, Entity
from orchestra.description.fields import Literal, Text
from orchestra.description.marks import NotEmpty
from orchestra.description.model import field


class Choice(Entity):
    """One of the values that an argument may have."""

    value: Literal = field(description="The value.")


class Arg(Action):
    """A launch argument, from here on visible as `$(var NAME)`."""

    name: Literal = field(
        description="Name of the argument: `name:=value` on the command line, `$(var name)` here."
    )
    default: Text | None = field(default=None, description="Value where the caller gives none.")
    description: Literal | None = field(default=None, description="What it is for; shown by `--show-args`.")
    choice: Annotated[tuple[Choice, ...], NotEmpty()] | None = field(
        default=None, description="The values it may have, as XML writes them."
    )
    choices: Annotated[tuple[Literal, ...], NotEmpty()] | None = field(
        default=None, description="The values it may have."
    )
