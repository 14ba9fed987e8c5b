"""`ProcessExited`: a process has ended."""

from __future__ import annotations

from typing import Any

from orchestra.compat.launch.events.process.running_process_event import RunningProcessEvent


class ProcessExited(RunningProcessEvent):
    """A process has ended."""

    name = "launch.events.process.ProcessExited"

    def __init__(self, *, returncode: int, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__returncode = returncode

    @property
    def returncode(self) -> int:
        """The exit status; negative: the signal that ended it."""
        return self.__returncode
