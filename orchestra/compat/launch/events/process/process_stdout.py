"""`ProcessStdout`: a process writes to its standard output."""

from __future__ import annotations

from typing import Any

from orchestra.compat.launch.events.process.process_io import STDOUT, ProcessIO


class ProcessStdout(ProcessIO):
    """A process writes to its standard output."""

    name = "launch.events.process.ProcessStdout"

    def __init__(self, *, text: bytes, **kwargs: Any) -> None:
        super().__init__(text=text, fd=STDOUT, **kwargs)
