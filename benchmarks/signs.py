"""Signs of life: each process writes a line to a pipe with a name, and whoever measures sees when it comes."""

from __future__ import annotations

import os
import select
import time
from typing import TYPE_CHECKING, Self

from benchmarks.launching import PATIENCE

if TYPE_CHECKING:
    from pathlib import Path


class Signs:
    """Reads the lines of all processes, as they come."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.lines: list[str] = []
        os.mkfifo(path)
        # Open for writing too, so that it has no end when the first writer goes.
        self._descriptor = os.open(path, os.O_RDWR | os.O_NONBLOCK)
        self._held = b""

    def __enter__(self) -> Self:
        """Begin to read."""
        return self

    def __exit__(self, *_: object) -> None:
        os.close(self._descriptor)

    def wait(self, count: int) -> float:
        """Wait until so many lines have come in all; return when the last of them came. Raises `TimeoutError`."""
        deadline = time.perf_counter() + PATIENCE
        now = time.perf_counter()
        while len(self.lines) < count:
            if not select.select([self._descriptor], [], [], max(0.0, deadline - now))[0]:
                raise TimeoutError(f"{len(self.lines)} of {count} signs came")
            data = os.read(self._descriptor, 1 << 16)
            now = time.perf_counter()
            *lines, self._held = (self._held + data).split(b"\n")
            self.lines += (line.decode() for line in lines)
        return now
