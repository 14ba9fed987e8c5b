"""`set_env`: sets an environment variable."""

from __future__ import annotations

from orchestra.description.entity import Action
from orchestra.description.fields import Text
from orchestra.description.model import field


class SetEnv(Action):
    """Set an environment variable for every process that follows in this scope."""

    name: Text = field(description="Name of the variable.")
    value: Text = field(description="Its value from here on.")
