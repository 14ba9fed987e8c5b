"""The actions that make the scope of a group, for those who go through its entities."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.launch.actions.pop_environment import PopEnvironment
from orchestra.compat.launch.actions.pop_launch_configurations import PopLaunchConfigurations
from orchestra.compat.launch.actions.push_environment import PushEnvironment
from orchestra.compat.launch.actions.push_launch_configurations import PushLaunchConfigurations
from orchestra.compat.launch.actions.reset_environment import ResetEnvironment
from orchestra.compat.launch.actions.reset_launch_configurations import ResetLaunchConfigurations
from orchestra.compat.launch.actions.set_launch_configuration import SetLaunchConfiguration

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity
    from orchestra.compat.text import Sub


def before(settings: Mapping[Sub, Sub], *, scoped: bool, forwarding: bool) -> list[LaunchDescriptionEntity]:
    """Return the actions that begin a scope, in which configurations are set."""
    if scoped and not forwarding:
        return [
            PushLaunchConfigurations(),
            PushEnvironment(),
            ResetEnvironment(),
            ResetLaunchConfigurations(settings),
        ]
    scope = [PushLaunchConfigurations(), PushEnvironment()] if scoped else []
    return [*scope, *(SetLaunchConfiguration(name, value) for name, value in settings.items())]


def after(*, scoped: bool) -> list[LaunchDescriptionEntity]:
    """Return the actions that end it."""
    return [PopEnvironment(), PopLaunchConfigurations()] if scoped else []
