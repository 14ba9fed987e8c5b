"""One fork server: started, asked, heard, and ended."""

from __future__ import annotations

import _socket
import array
import json
import os
import signal
from typing import TYPE_CHECKING, Any

from orchestra.supervise.keeping.kin import send_to_groups
from orchestra.supervise.output.stream import Stream, as_text
from orchestra.supervise.process.ending import Ending

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from orchestra.supervise.keeping.kin import Kin
    from orchestra.supervise.loop import Loop
    from orchestra.supervise.process.child import Child
    from orchestra.supervise.warm.launching import Launched

_LARGEST = 65536  # bytes of a message from it


class Server:
    """A running fork server. `heard` gets its messages, `lost` is called once where it ends without having been let go.

    `environment` are the variables that it has, `said` gets what it writes itself.
    """

    def __init__(
        self,
        loop: Loop,
        kin: Kin,
        launched: Launched,
        said: Callable[[str], None],
        ears: tuple[Callable[[dict[str, Any]], None], Callable[[str], None]],
    ) -> None:
        self._loop = loop
        self._kin = kin
        self._heard, self._lost = ears
        self.environment: Mapping[str, str] = launched.environment
        self._child: Child | None = launched.child
        ours = launched.connection
        self._socket: _socket.socket | None = ours
        # Another descriptor of the same socket: the loop has one callback for each.
        self._writable = os.dup(ours.fileno())
        self._waiting: list[tuple[bytes, Sequence[int], Callable[[], None] | None]] = []
        self._held_up = False
        kin.add(launched.child.pid, None)
        self._streams = [
            Stream(loop, descriptor, as_text(said)) for descriptor in launched.child.outputs.values()
        ]
        loop.on_readable(ours.fileno(), self._read)
        loop.on_readable(launched.child.pidfd, self._ended)

    @property
    def pid(self) -> int | None:
        """Its pid, until it has been reaped."""
        return self._child.pid if self._child else None

    @property
    def alive(self) -> bool:
        """Whether its process has not been reaped."""
        return self._child is not None

    def tell(
        self,
        message: Mapping[str, Any],
        descriptors: Sequence[int] = (),
        sent: Callable[[], None] | None = None,
    ) -> None:
        """Send a message with descriptors, now or when it can be taken; `sent` is called when they are on their way."""
        if self._socket is None:
            return
        idle = not self._waiting
        self._waiting.append((json.dumps(message).encode(), descriptors, sent))
        if idle:
            self._send()
            if self._waiting and self._socket is not None:
                self._loop.on_writable(self._writable, self._go_on)
                self._held_up = True

    def leave(self) -> None:
        """Let it end: it does when nobody can ask any more."""
        if self._socket is None:
            return
        self._stop_waiting()
        self._waiting.clear()
        os.close(self._writable)
        self._loop.forget(self._socket.fileno())
        self._socket.close()
        self._socket = None

    def kill(self) -> None:
        """End it now; it is not lost by that."""
        self.leave()
        if self._child:
            send_to_groups([self._child.pid], signal.SIGKILL)

    def _go_on(self) -> None:
        self._send()
        if not self._waiting:
            self._stop_waiting()

    def _stop_waiting(self) -> None:
        if self._held_up:
            self._held_up = False
            self._loop.forget(self._writable)

    def _send(self) -> None:
        """Send what waits, as much as is taken."""
        while self._waiting and self._socket is not None:
            content, descriptors, sent = self._waiting[0]
            rights = (
                [(_socket.SOL_SOCKET, _socket.SCM_RIGHTS, array.array("i", descriptors))]
                if descriptors
                else []
            )
            try:
                self._socket.sendmsg([content], rights)
            except BlockingIOError:
                return
            except OSError as error:
                self._read_last_words()
                self._lose(f"takes no requests any more: {error.strerror}")
                return
            del self._waiting[0]
            if sent:
                sent()

    def _read(self) -> None:
        if self._socket is None:
            return
        try:
            content = _received(self._socket, _LARGEST)
        except BlockingIOError:
            return
        except OSError:
            content = b""
        if content:
            self._heard(json.loads(content))
        else:
            self._lose("has closed its connection")

    def _lose(self, reason: str) -> None:
        if self._socket is not None:
            self.kill()
            self._lost(reason)

    def _ended(self) -> None:
        child = self._child
        ended = child.ended() if child else None
        if child is None or ended is None:
            return
        self._loop.forget(child.pidfd)
        for stream in self._streams:
            stream.close()
        self._kin.remove(child.pid)
        child.reap()
        self._child = None
        self._read_last_words()
        self._lose(f"ended ({Ending(*ended)})")

    def _read_last_words(self) -> None:
        """Hear what it has sent before its end."""
        while self._waits():
            self._read()

    def _waits(self) -> bool:
        """Tell whether something that it has sent is still to be read."""
        try:
            return self._socket is not None and bool(_received(self._socket, 1, _socket.MSG_PEEK))
        except OSError:
            return False


def _received(connection: _socket.socket, size: int, flags: int = 0) -> bytes:
    """Read a message. That the other end has not read all of ours the kernel tells once, before its last words."""
    try:
        return connection.recv(size, flags)
    except ConnectionResetError:
        return connection.recv(size, flags)
