"""What a process notifies us of: datagrams to the socket in its NOTIFY_SOCKET (sd_notify(3)).

The socket is abstract (unix(7)): it needs no file, so none is left whatever happens to us, and no path can be too long
for it. Every start of the process has one of its own, so that what is left of one run speaks for no other.

A message counts only where it comes from the process, from a descendant, or from what carries its marks; the kernel
says who has sent it (SCM_CREDENTIALS). As with systemd, one whose sender has been reaped when it is read cannot be
attributed and is dropped; systemd-notify(1) waits for that reason (BARRIER=1). Descriptors that come with a message are
closed as soon as it has been heard, which is what BARRIER=1 waits for; none is kept (FDSTORE=1).

WATCHDOG_PID is not set: it would name a shell or a prefix before the program. Whoever has WATCHDOG_USEC then knows that
it is meant (sd_watchdog_enabled(3)).
"""

from __future__ import annotations

import os
import struct
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import socket
    from collections.abc import Callable, Mapping

    from orchestra.plan.model import Process
    from orchestra.supervise.loop import Timer
    from orchestra.supervise.surroundings import Surroundings

# systemd reads no longer messages either (NOTIFY_BUFFER_MAX).
_LONGEST = 4096
_MOST_VALUE = 512
_LONGEST_TIME = 2**63  # in microseconds; whoever gives more means for ever
_KEPT = frozenset({"STATUS", "WATCHDOG_USEC"})
# All descriptors that can come with a message (SCM_MAX_FD of the kernel), so that none stays open unnoticed.
_MOST_DESCRIPTORS = 253
_CREDENTIALS = struct.Struct("iII")  # pid, uid, gid (unix(7))
# After so many messages others have their turn, and after as many again a pause is made, in seconds.
_BATCH = 64
_PAUSE = 0.05


class Notices:
    """The notifications of one process, heard by whoever has asked for a variable."""

    def __init__(self, process: Process, surroundings: Surroundings) -> None:
        self._process = process
        self._around = surroundings
        self._heard: dict[tuple[str, str], Callable[[str], None]] = {}
        self._socket: socket.socket | None = None
        self._pause: Timer | None = None
        self._complained = False
        self._latest: dict[str, str] = {}

    def latest(self, variable: str) -> str | None:
        """Return what the process has said last in this run, of its status and of what counts later too."""
        return self._latest.get(variable)

    def on(self, variable: str, heard: Callable[[str], None], owner: str = "") -> None:
        """Have the values of a variable heard; a later one of the same owner takes its place."""
        self._heard[variable, owner] = heard

    def begin(self) -> dict[str, str]:
        """Open the socket of a new run; return what the environment of the process has for it, nothing without need.

        Raises `OSError` where there is none to be had.
        """
        self.end()
        self._latest.clear()
        ready, alive = self._process.ready, self._process.alive
        watchdog = alive.notify if alive else None
        if watchdog is None and not (ready and ready.notify):
            return {}
        name = f"orchestra/{os.getpid()}/{os.urandom(8).hex()}"
        self._socket = _bound(name)
        self._around.loop.on_readable(self._socket.fileno(), self._read)
        limit = {} if watchdog is None else {"WATCHDOG_USEC": str(round(watchdog * 1e6))}
        return {"NOTIFY_SOCKET": f"@{name}", **limit}

    def end(self) -> None:
        """Read what has come, and close the socket."""
        if self._socket:
            self.drain()
            if self._pause is None:
                self._around.loop.forget(self._socket.fileno())
            else:
                self._pause.cancel()
                self._pause = None
            self._socket.close()
            self._socket = None

    def drain(self) -> None:
        """Read what has come by now: a process may say something and end."""
        self._read_batch()

    def _read(self) -> None:
        """Read some messages; who sends them faster than they are read has to wait."""
        if self._read_batch() and self._socket and self._pause is None:
            self._around.loop.forget(self._socket.fileno())
            self._pause = self._around.loop.call_later(_PAUSE, self._go_on)

    def _go_on(self) -> None:
        self._pause = None
        if self._socket:
            self._around.loop.on_readable(self._socket.fileno(), self._read)

    def _read_batch(self) -> bool:
        """Read some messages; tell whether there may be more."""
        known: dict[int | None, bool] = {}  # the kernel gives a pid to nobody else as fast as that
        return all(self._socket and self._read_one(self._socket, known) for _ in range(_BATCH))

    def _read_one(self, opened: socket.socket, known: dict[int | None, bool]) -> bool:
        """Read a message; tell whether there was one."""
        import socket  # noqa: PLC0415 - few processes notify

        space = socket.CMSG_SPACE(_CREDENTIALS.size) + socket.CMSG_SPACE(_MOST_DESCRIPTORS * 4)
        try:
            data, ancillary, flags, _ = opened.recvmsg(_LONGEST, space, socket.MSG_CMSG_CLOEXEC)
        except OSError:  # nothing is there, or no memory for it: the loop tells when to look again
            return False
        try:
            sender = _sender(ancillary)
            if sender not in known:
                known[sender] = self._is_from_it(sender)
            if known[sender] and not flags & socket.MSG_TRUNC:
                self._hear(parse(data))
        finally:
            for descriptor in _descriptors(ancillary):
                os.close(descriptor)
        return True

    def _is_from_it(self, pid: int | None) -> bool:
        if pid and self._around.kin.owner(pid) == self._process.id:
            return True
        if not self._complained:
            self._complained = True
            who = f"process {pid}, which is none of its own" if pid else "somebody unknown"
            self._around.journal.note(f"a notification for {self._process.id} came from {who}: it is ignored")
        return False

    def _hear(self, values: Mapping[str, str]) -> None:
        for name, value in values.items():
            if name in _KEPT:
                self._latest[name] = value
            for (variable, _), heard in [*self._heard.items()]:
                if variable == name:
                    heard(value)


def parse(message: bytes) -> dict[str, str]:
    """Return the assignments of a message, of which each has a line; what is none is left out."""
    assignments = {}
    for line in message.decode("utf-8", "replace").split("\n"):
        name, equals, value = line.partition("=")
        if equals and name:
            assignments[name] = "".join(filter(str.isprintable, value[:_MOST_VALUE]))
    return assignments


def seconds(microseconds: str | None) -> float | None:
    """Return a time that a message gives in microseconds; None where it is none, or 0."""
    if microseconds is None or not microseconds.isascii() or not microseconds.isdigit():
        return None
    return min(int(microseconds), _LONGEST_TIME) / 1e6 or None


def _bound(name: str) -> socket.socket:
    import socket  # noqa: PLC0415 - as above

    opened = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_NONBLOCK | socket.SOCK_CLOEXEC)
    try:
        opened.setsockopt(socket.SOL_SOCKET, socket.SO_PASSCRED, 1)
        opened.bind(f"\0{name}")
    except OSError:
        opened.close()
        raise
    return opened


def _sender(ancillary: list[tuple[int, int, bytes]]) -> int | None:
    import socket  # noqa: PLC0415 - as above

    for level, kind, data in ancillary:
        if (level, kind) == (socket.SOL_SOCKET, socket.SCM_CREDENTIALS) and len(data) == _CREDENTIALS.size:
            pid, _, _ = _CREDENTIALS.unpack(data)
            return int(pid)
    return None


def _descriptors(ancillary: list[tuple[int, int, bytes]]) -> list[int]:
    # As above.
    import array  # noqa: PLC0415
    import socket  # noqa: PLC0415

    found = array.array("i")
    for level, kind, data in ancillary:
        if (level, kind) == (socket.SOL_SOCKET, socket.SCM_RIGHTS):
            found.frombytes(data[: len(data) - len(data) % found.itemsize])
    return [*found]
