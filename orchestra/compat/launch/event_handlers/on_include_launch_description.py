"""`OnIncludeLaunchDescription`: has the description of an event visited."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.event_handler import BaseEventHandler
from orchestra.compat.launch.events.include_launch_description import IncludeLaunchDescription

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity


class OnIncludeLaunchDescription(BaseEventHandler):
    """Wait for events that bring a launch description, and have it visited."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(matcher=_brings_description, **kwargs)

    def handle(self, event: Any, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Return the description."""
        super().handle(event, context)
        return [event.launch_description]

    @property
    def handler_description(self) -> str:
        """What is done."""
        return "visits the launch description"

    @property
    def matcher_description(self) -> str:
        """Which events are meant."""
        return "event issubclass of launch.events.IncludeLaunchDescription"


def _brings_description(event: Any) -> bool:
    return isinstance(event, IncludeLaunchDescription)
