"""`DeclareBooleanLaunchArgument` (newer ROS releases): declares a launch argument that is true or false."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.actions.declare_launch_argument import DeclareLaunchArgument

if TYPE_CHECKING:
    from orchestra.compat.text import Sub

_CHOICES = ("true", "false", "True", "False", "TRUE", "FALSE")


class DeclareBooleanLaunchArgument(DeclareLaunchArgument):
    """Declare an argument of the launch file that is true or false."""

    def __init__(self, name: str, *, default_value: Sub | bool | None = None, **kwargs: Any) -> None:
        default = str(default_value) if isinstance(default_value, bool) else default_value
        super().__init__(name, default_value=default, choices=_CHOICES, **kwargs)
