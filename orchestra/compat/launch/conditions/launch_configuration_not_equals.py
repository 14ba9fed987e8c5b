"""`LaunchConfigurationNotEquals`: holds where a launch configuration has not a value."""

from __future__ import annotations

from orchestra.compat.launch.conditions.launch_configuration_equals import LaunchConfigurationEquals


class LaunchConfigurationNotEquals(LaunchConfigurationEquals):
    """Holds where the configuration is anything but the text; None: where it is set."""

    _wanted = False
