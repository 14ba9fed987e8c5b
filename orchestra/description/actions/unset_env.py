"""`unset_env`: removes an environment variable."""

from __future__ import annotations

from pydantic import Field

from orchestra.description.entity import Action
from orchestra.description.fields import Text


class UnsetEnv(Action):
    """Remove an environment variable for every process that follows in this scope."""

    name: Text = Field(description="Name of the variable.")
