"""`unset_env`: removes an environment variable."""

from __future__ import annotations

from orchestra.description.entity import Action
from orchestra.description.fields import Text
from orchestra.description.model import field


class UnsetEnv(Action):
    """Remove an environment variable for every process that follows in this scope."""

    name: Text = field(description="Name of the variable.")
