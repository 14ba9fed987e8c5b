"""What a process of the plan writes, and what is typed to it: from its descriptors to whoever wants to know."""

from __future__ import annotations

import os
from functools import partial
from typing import TYPE_CHECKING

from orchestra.supervise.output.attachment import Attachment
from orchestra.supervise.output.stream import Stream
from orchestra.supervise.output.terminal import Terminal

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from typing import TypeAlias

    from orchestra.supervise.process.child import Child
    from orchestra.supervise.surroundings import Surroundings

    # Of a stream: its name and a piece of output.
    Heard: TypeAlias = Callable[[str, bytes], None]
    # Of a program: its pid, the name of the stream, and the bytes.
    Wrote: TypeAlias = Callable[[int, str, bytes], None]

_STDOUT = 1


class Output:
    """The streams of a process, over all its runs. `heard` gets whole lines, `wrote` the bytes as they come."""

    def __init__(self, process: str, surroundings: Surroundings, heard: Heard, wrote: Wrote) -> None:
        self._process = process
        self._around = surroundings
        self._heard = heard
        self._wrote = wrote
        self._streams: list[Stream] = []
        self._terminal: Terminal | None = None
        self._let_through = False
        self.attachment = Attachment()

    def begin(self, child: Child, environment: Mapping[str, str], *, foremost: bool) -> None:
        """Read what a program writes; `foremost` is the one to which the user types."""
        around = self._around
        around.journal.begin(self._process, child.pid, environment)
        self._let_through = foremost and os.isatty(_STDOUT)
        if child.tty:
            drained = around.console.drained if foremost else None
            self._terminal = Terminal(around.loop, child.pid, child.outputs.values(), drained)
            around.console.opened(self._terminal, foremost=foremost)
        self.attachment.began(self._terminal)
        self._streams = [
            Stream(
                around.loop,
                descriptor,
                partial(self._deliver, name),
                partial(self._tapped, child.pid, name),
                around.intake,
            )
            for name, descriptor in child.outputs.items()
        ]

    def drain(self) -> None:
        """Read what is there now."""
        for stream in self._streams:
            stream.drain()

    def end(self) -> None:
        """Nothing is left of the run, as far as we know; whoever else holds a stream open is read on."""
        for stream in self._streams:
            stream.part()
        self._streams = []
        self.attachment.ended()
        if self._terminal:
            self._around.console.closed(self._terminal)
            self._terminal.close()
            self._terminal = None
        self._around.journal.rest(self._process)

    def _deliver(self, stream: str, data: bytes) -> None:
        self._around.journal.output(self._process, stream, data, shown=not self._let_through)
        self._heard(stream, data)

    def _tapped(self, pid: int, stream: str, data: bytes) -> None:
        if self._let_through:
            self._around.journal.let_through(self._process, data)
        self.attachment.feed(data)
        self._wrote(pid, stream, data)
