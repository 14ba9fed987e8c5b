"""Signs of life: each process writes a line to a pipe with a name, and whoever measures sees when it comes."""

from __future__ import annotations

import os
import select
import time
from typing import TYPE_CHECKING, Self

from benchmarks.launching import PATIENCE

if TYPE_CHECKING:
    import subprocess
    from pathlib import Path

# How often it is looked whether signs can still come, where none do, in seconds.
_LOOK = 1.0


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

    def wait(self, count: int, launcher: subprocess.Popen[bytes] | None = None) -> float:
        """Wait until so many lines have come in all; return when the last of them came.

        Raises `TimeoutError`, and `RuntimeError` where the launcher has ended before.
        """
        deadline = time.perf_counter() + PATIENCE
        now = time.perf_counter()
        while len(self.lines) < count:
            if not select.select([self._descriptor], [], [], _LOOK)[0]:
                self._expect(count, launcher, deadline)
                continue
            data = os.read(self._descriptor, 1 << 16)
            now = time.perf_counter()
            *lines, self._held = (self._held + data).split(b"\n")
            self.lines += (line.decode() for line in lines)
        return now

    def _expect(self, count: int, launcher: subprocess.Popen[bytes] | None, deadline: float) -> None:
        """Raise where no more signs will come."""
        if time.perf_counter() > deadline:
            raise TimeoutError(f"{len(self.lines)} of {count} signs came")
        if launcher and launcher.poll() is not None:
            raise RuntimeError(f"{launcher.args!r} ended before all signs came")
