"""`SetEnvironmentVariable`: sets an environment variable."""

from __future__ import annotations

from orchestra.compat.launch.actions.named import SettingAction
from orchestra.description.actions.set_env import SetEnv


class SetEnvironmentVariable(SettingAction):
    """Set an environment variable for what follows in this scope."""

    _model = SetEnv
    _plain = (2, ("name", "value"))
