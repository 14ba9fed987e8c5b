"""`ProcessStdin`: a process reads."""

from __future__ import annotations

from typing import Any

from orchestra.compat.launch.events.process.process_io import STDIN, ProcessIO


class ProcessStdin(ProcessIO):
    """A process reads."""

    name = "launch.events.process.ProcessStdin"

    def __init__(self, *, text: bytes, **kwargs: Any) -> None:
        super().__init__(text=text, fd=STDIN, **kwargs)
