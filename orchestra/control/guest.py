"""One client, as the server sees it: reads its lines, a few at a time, and sends it what it is to have."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.control import protocol
from orchestra.control.outlet import Outlet
from orchestra.control.protocol import LONGEST_REQUEST, Refusal

if TYPE_CHECKING:
    import socket
    from collections.abc import Callable

    from orchestra.control.protocol import Request
    from orchestra.supervise.loop import Loop

_READ_SIZE = 65536
# How many lines of one client are seen to before the others, and the run itself, have their turn.
_LINES_PER_TURN = 4


class Guest:
    """A connected client. `serve` is called with what it wants, `left` when it has gone."""

    def __init__(
        self,
        loop: Loop,
        connection: socket.socket,
        serve: Callable[[Guest, Request], None],
        left: Callable[[Guest], None],
    ) -> None:
        self._loop = loop
        self._connection = connection
        self._serve = serve
        self._left = left
        self._received = bytearray()
        self._reading = False
        self._outlet = Outlet(loop, connection, lambda _reason: self.leave())
        self._farewells: list[Callable[[], None]] = []
        self.open = True
        self._read_on()

    def send(self, message: bytes) -> None:
        """Let it have a message, now or when it reads; it is given up where too much waits for it."""
        self._outlet.send(message)

    def at_leave(self, farewell: Callable[[], None]) -> None:
        """Have something called when it goes."""
        self._farewells.append(farewell)

    def at_drain(self, drained: Callable[[], None] | None) -> None:
        """Have something called whenever it has taken all that waited for it; None for nothing."""
        self._outlet.drained = drained

    @property
    def pending(self) -> int:
        """The number of bytes that it has not taken yet."""
        return self._outlet.pending

    def push(self) -> None:
        """Send what it takes now."""
        self._outlet.push()

    def catch_up(self) -> None:
        """Read what it has said by now, its leave among it."""
        if self._reading:
            self._read()

    def descriptor(self) -> int:
        """The descriptor of the connection."""
        return self._connection.fileno()

    def leave(self) -> None:
        """Part from it; what it has not taken is lost."""
        if not self.open:
            return
        self.open = False
        self._read_no_more()
        self._outlet.close()
        self._connection.close()
        for farewell in self._farewells:
            farewell()
        self._left(self)

    def _read(self) -> None:
        try:
            data = self._connection.recv(_READ_SIZE)
        except BlockingIOError:
            return
        except OSError:
            data = b""
        if data:
            self._received += data
            self._take_lines()
        else:
            self._end()

    def _end(self) -> None:
        """It says nothing any more; a line that was cut off is none."""
        if self._received:
            self.send(protocol.refusal(None, Refusal("malformed", "the last line has no end")))
        self.leave()

    def _take_lines(self) -> None:
        for _ in range(_LINES_PER_TURN):
            end = self._received.find(b"\n")
            if (end if end >= 0 else len(self._received)) > LONGEST_REQUEST:
                what = f"a line has more than {LONGEST_REQUEST} bytes"
                self.send(protocol.refusal(None, Refusal("oversized", what)))
                self.leave()
                return
            if end < 0:
                self._read_on()
                return
            line = bytes(self._received[:end])
            del self._received[: end + 1]
            if line.strip():
                self._take(line)
            if not self.open:
                return
        self._read_no_more()
        self._loop.call_later(0.0, self._go_on)

    def _go_on(self) -> None:
        if self.open:
            self._take_lines()

    def _take(self, line: bytes) -> None:
        try:
            request = protocol.decode(line)
        except Refusal as why:
            self.send(protocol.refusal(None, why))
            return
        self._serve(self, request)

    def _read_on(self) -> None:
        if not self._reading:
            self._reading = True
            self._loop.on_readable(self.descriptor(), self._read)

    def _read_no_more(self) -> None:
        if self._reading:
            self._reading = False
            self._loop.forget(self.descriptor())
