"""Writes the event stream."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from orchestra import events

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.events import Kind
    from orchestra.logs.writer import LogFile


class Recorder:
    """Turns what happened into events with both times, and appends them to a file. `count` is how many there are."""

    def __init__(
        self,
        file: LogFile,
        wall: Callable[[], float] = time.time,
        monotonic: Callable[[], float] = time.monotonic,
    ) -> None:
        self._file = file
        self._wall = wall
        self._monotonic = monotonic
        self._listeners: list[Callable[[str], None]] = []
        self.count = 0

    def record(
        self,
        kind: Kind,
        process: str | None = None,
        *,
        pid: int | None = None,
        cause: str | None = None,
        **data: Any,  # noqa: ANN401 - JSON
    ) -> None:
        """Append an event."""
        event = events.Event(self._wall(), self._monotonic(), kind, process, pid, cause, data)
        line = events.dumps(event)
        self._file.write((line + "\n").encode("utf-8", "surrogateescape"))
        self.count += 1
        for listener in self._listeners:
            listener(line)

    def listen(self, listener: Callable[[str], None]) -> None:
        """Let a listener have the line of each event from now on, once it is on its way to the file."""
        self._listeners.append(listener)

    def close(self) -> None:
        """Close the stream."""
        self._file.close()
