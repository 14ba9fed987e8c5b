"""Log files that never stop a run: what cannot be written is counted, and told once."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path


class LogFile:
    """A file to append to. `failed` is called with the error at the first write that fails; `lost` counts bytes."""

    def __init__(self, path: Path, failed: Callable[[Path, OSError], None]) -> None:
        self._path = path
        self._failed = failed
        self._descriptor: int | None = None
        self.lost = 0

    def write(self, text: str) -> None:
        """Append text at once, unbuffered: what a crash leaves behind is complete."""
        data = memoryview(text.encode("utf-8", "surrogateescape"))
        try:
            descriptor = self._open()
            while data:
                data = data[os.write(descriptor, data) :]
        except OSError as error:
            first = not self.lost
            self.lost += len(data)
            if first:
                self._failed(self._path, error)

    def close(self) -> None:
        """Close the file; writing opens it again."""
        if self._descriptor is not None:
            os.close(self._descriptor)
            self._descriptor = None

    def _open(self) -> int:
        if self._descriptor is None:
            flags = os.O_WRONLY | os.O_APPEND | os.O_CREAT | os.O_CLOEXEC | os.O_NOCTTY
            self._descriptor = os.open(self._path, flags, 0o644)
        return self._descriptor
