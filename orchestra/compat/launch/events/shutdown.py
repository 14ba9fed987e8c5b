"""The event with which a run ends; the action of the same name, which emits it, is in `launch.actions`."""

from __future__ import annotations

from typing import Any

from orchestra.compat.launch.event import Event


class Shutdown(Event):
    """The run ends. `reason` is a text."""

    name = "launch.events.Shutdown"

    def __init__(
        self,
        *,
        reason: Any = "reason not given",
        due_to_sigint: bool = False,
    ) -> None:
        self.__reason = reason
        self.__due_to_sigint = due_to_sigint

    @property
    def reason(self) -> Any:
        """Why."""
        return self.__reason

    @property
    def due_to_sigint(self) -> bool:
        """Whether somebody pressed Ctrl-C."""
        return self.__due_to_sigint
