"""`ProcessStderr`: a process writes to its standard error."""

from __future__ import annotations

from typing import Any

from orchestra.compat.launch.events.process.process_io import STDERR, ProcessIO


class ProcessStderr(ProcessIO):
    """A process writes to its standard error."""

    name = "launch.events.process.ProcessStderr"

    def __init__(self, *, text: bytes, **kwargs: Any) -> None:
        super().__init__(text=text, fd=STDERR, **kwargs)
