"""`append_env`: adds to an environment variable."""

from __future__ import annotations

from pydantic import Field

from orchestra.description.entity import Action
from orchestra.description.fields import Flag, Text


class AppendEnv(Action):
    """Add to an environment variable for every process that follows in this scope; set it where it is unset."""

    name: Text = Field(description="Name of the variable.")
    value: Text = Field(description="What is added.")
    prepend: Flag | None = Field(default=None, description="Whether it goes in front instead of behind.")
    separator: Text | None = Field(
        default=None, description="What stands between the old and the new; a colon where absent."
    )
