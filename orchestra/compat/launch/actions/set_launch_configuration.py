"""`SetLaunchConfiguration`: sets a launch configuration."""

from __future__ import annotations

from orchestra.compat.launch.actions.named import SettingAction
from orchestra.description.actions.let import Let


class SetLaunchConfiguration(SettingAction):
    """Set a launch configuration for what follows in this scope."""

    _model = Let
    _plain = (2, ("name", "value"))
