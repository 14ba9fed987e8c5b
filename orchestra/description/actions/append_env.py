"""`append_env`: adds to an environment variable."""

from __future__ import annotations

from orchestra.description.entity import Action
from orchestra.description.fields import Flag, Text
from orchestra.description.model import field


class AppendEnv(Action):
    """Add to an environment variable for every process that follows in this scope; set it where it is unset."""

    name: Text = field(description="Name of the variable.")
    value: Text = field(description="What is added.")
    prepend: Flag | None = field(default=None, description="Whether it goes in front instead of behind.")
    separator: Text | None = field(
        default=None, description="What stands between the old and the new; a colon where absent."
    )
