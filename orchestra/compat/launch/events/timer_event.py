"""`TimerEvent`: a timer has gone off."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.launch.event import Event

if TYPE_CHECKING:
    from orchestra.compat.launch.action import Action


class TimerEvent(Event):
    """The period of a `TimerAction` is over."""

    name = "launch.events.TimerEvent"

    def __init__(self, *, timer_action: Action) -> None:
        self.__timer_action = timer_action

    @property
    def timer_action(self) -> Action:
        """The timer."""
        return self.__timer_action
