"""`ExecutionComplete`: an action is done."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.launch.event import Event

if TYPE_CHECKING:
    from orchestra.compat.launch.action import Action


class ExecutionComplete(Event):
    """An action is done: a process has ended for good, any other one has been executed."""

    name = "launch.events.ExecutionComplete"

    def __init__(self, *, action: Action) -> None:
        self.__action = action

    @property
    def action(self) -> Action:
        """The action."""
        return self.__action
