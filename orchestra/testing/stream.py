"""The events of a run while it goes on, read from its event stream."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra import events

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from orchestra.events import Event


class EventStream:
    """Reads the one event stream below a home folder, each line once; a line is read when it is complete."""

    def __init__(self, home: Path) -> None:
        self._home = home
        self._read = 0
        self._found: list[Event] = []

    @property
    def path(self) -> Path | None:
        """The file of the stream, None before the run has begun."""
        return next(self._home.glob("runs/*/events.jsonl"), None)

    def events(self) -> tuple[Event, ...]:
        """Return all that has happened so far."""
        self._found.extend(self._new())
        return tuple(self._found)

    def _new(self) -> Iterator[Event]:
        path = self.path
        if path is None:
            return
        with path.open("rb") as file:
            file.seek(self._read)
            for line in file:
                if not line.endswith(b"\n"):
                    return
                self._read += len(line)
                yield events.loads(line)
