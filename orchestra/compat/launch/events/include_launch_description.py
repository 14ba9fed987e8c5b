"""The event that has a launch description visited; the action of the same name is in `launch.actions`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.launch.event import Event

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_description import LaunchDescription


class IncludeLaunchDescription(Event):
    """A launch description is to be visited."""

    name = "launch.events.IncludeLaunchDescription"

    def __init__(self, launch_description: LaunchDescription) -> None:
        self.__launch_description = launch_description

    @property
    def launch_description(self) -> LaunchDescription:
        """The description."""
        return self.__launch_description
