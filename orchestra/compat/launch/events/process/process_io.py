"""`ProcessIO`: a process reads or writes."""

from __future__ import annotations

from typing import Any, Final

from orchestra.compat.launch.events.process.running_process_event import RunningProcessEvent

STDIN: Final = 0
STDOUT: Final = 1
STDERR: Final = 2


class ProcessIO(RunningProcessEvent):
    """Some bytes have gone through one of the standard streams; they may end anywhere in a line."""

    name = "launch.events.process.ProcessIO"

    def __init__(self, *, text: bytes, fd: int, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__text = text
        self.__fd = fd

    @property
    def text(self) -> bytes:
        """The bytes."""
        return self.__text

    @property
    def from_stdin(self) -> bool:
        """Whether the process reads them."""
        return self.__fd == STDIN

    @property
    def from_stdout(self) -> bool:
        """Whether they come from its standard output."""
        return self.__fd == STDOUT

    @property
    def from_stderr(self) -> bool:
        """Whether they come from its standard error."""
        return self.__fd == STDERR
