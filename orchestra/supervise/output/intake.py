"""How fast output may be read: as fast as the disk takes it, so that a fast program waits for its pipe.

Whoever reads asks `full` before each read; where it is, nothing is read until there is room again. A disk that takes
nothing at all is given up after a while, since a robot's nodes must not stand still because of it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from orchestra.logs.writer import STUCK_AFTER

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.logs.writer import Writer
    from orchestra.supervise.loop import Loop, Timer

    class Closable(Protocol):
        """A stream that is still open."""

        def close(self) -> None:
            """Read what is there, and let go."""


class Intake:
    """Lets streams wait for the writer; `stuck` is called when the disk is given up."""

    def __init__(self, loop: Loop, writer: Writer, stuck: Callable[[], None]) -> None:
        self._loop = loop
        self._writer = writer
        self._stuck = stuck
        self._steps = 0
        self._timer: Timer | None = None
        self._remaining: set[Closable] = set()
        loop.on_readable(writer.descriptor, writer.attend)

    @property
    def full(self) -> bool:
        """Whether nothing more should be read for now."""
        return self._writer.full

    def wait(self, resume: Callable[[], None]) -> None:
        """Call when more may be read."""
        self._writer.when_room(resume)
        if self._timer is None:
            self._look_after()

    def leave(self, stream: Closable) -> None:
        """Take over a stream whose program is gone, and which somebody still holds open."""
        self._remaining.add(stream)

    def forget(self, stream: Closable) -> None:
        """A stream has come to its end."""
        self._remaining.discard(stream)

    def close(self) -> None:
        """Read what is left, and let the writer alone."""
        for stream in tuple(self._remaining):
            stream.close()
        if self._timer:
            self._timer.cancel()
        self._loop.forget(self._writer.descriptor)

    def _look_after(self) -> None:
        self._steps = self._writer.steps
        self._timer = self._loop.call_later(STUCK_AFTER, self._look)

    def _look(self) -> None:
        self._timer = None
        if not self._writer.full:
            return
        if self._writer.steps != self._steps:
            self._look_after()
        else:
            self._writer.give_up()
            self._stuck()
