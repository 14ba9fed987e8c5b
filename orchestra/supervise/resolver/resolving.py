"""Waits for the resolver's document; a stop signal ends the wait, and the resolver."""

from __future__ import annotations

import json
import os
import signal
from typing import TYPE_CHECKING, Any

from orchestra.supervise.keeping.kin import send_to_groups
from orchestra.supervise.process.ending import Ending, signal_name
from orchestra.supervise.resolver import document

if TYPE_CHECKING:
    from orchestra.supervise.loop import Loop
    from orchestra.supervise.resolver.document import Document
    from orchestra.supervise.resolver.process import Resolver

_READ_SIZE = 1 << 20
_SIGNALLED = 128


class Refused(Exception):  # noqa: N818 - nothing is wrong with the run: there is none
    """There is nothing to run. `status` is the exit status; the message is None where the user has been told."""

    def __init__(self, status: int, message: str | None = None) -> None:
        super().__init__(message)
        self.status = status
        self.message = message


class Collection:
    """Reads what the resolver writes until its document is complete, or somebody wants no run any more.

    A resolver that does not stay has to end, so that its status counts.
    """

    def __init__(self, resolver: Resolver, loop: Loop) -> None:
        self._resolver = resolver
        self._loop = loop
        self._header: dict[str, Any] | None = None
        self._content = bytearray()
        self._open = True
        self._ending: Ending | None = None
        self._signal: int | None = None
        self._began = loop.clock()
        self._pidfd = os.pidfd_open(resolver.pid)
        loop.on_readable(resolver.descriptor, self._read)
        loop.on_readable(self._pidfd, self._exited)

    def stop_signal(self, number: int) -> None:
        """End it all: nothing has been started yet."""
        self._signal = number if self._signal is None else self._signal
        send_to_groups([self._resolver.pid], signal.SIGKILL)

    @property
    def pid(self) -> int | None:
        """The pid of the resolver until it has been reaped."""
        return None if self._ending else self._resolver.pid

    def state_report(self) -> str:
        """Say what is waited for."""
        waited = self._loop.clock() - self._began
        return (
            f"  nothing has been started: for {waited:.1f} s the resolver has been reading the launch files"
        )

    @property
    def done(self) -> bool:
        """Whether there is an answer."""
        return self._ending is not None or (self.stays and self._signal is None)

    @property
    def stays(self) -> bool:
        """Whether the document is complete and the resolver waits for questions."""
        header = self._header
        return self._open and header is not None and header["stays"] and len(self._content) == header["size"]

    @property
    def settled(self) -> bool:
        """Whether a resolver that stays does so for itself: nobody has to wait for it, nor to ask it."""
        return self.stays and self._header is not None and self._header["settled"]

    def result(self) -> Document:
        """Return the document. Raises `Refused` where there is none."""
        if not self.stays:
            self.check_ending()
        try:
            return document.loads(bytes(self._content))
        except ValueError as error:
            raise Refused(
                3, f"this is a bug in Orchestra: the resolver handed over no plan: {error}"
            ) from error

    def dismiss(self) -> None:
        """Let a resolver go that would stay: it ends with the connection."""
        self._close()

    def check_ending(self) -> None:
        """Raise `Refused` where the resolver that has ended, or somebody else, wants no run."""
        ending = self._ending
        if self._signal is not None:
            raise Refused(
                _SIGNALLED + self._signal,
                f"stopped by {signal_name(self._signal)} before anything was started",
            )
        if ending is None or ending.signal is not None:
            raise Refused(
                1, f"the resolver, which reads the launch files, was ended by {ending}; nothing was started"
            )
        if ending.code:
            raise Refused(ending.code)

    def hand_on(self) -> None:
        """Stop listening: the connection and the process are somebody else's now."""
        self._open = False
        self._loop.forget(self._resolver.descriptor)
        self._loop.forget(self._pidfd)
        os.close(self._pidfd)

    def _read(self) -> bool:
        try:
            data = os.read(self._resolver.descriptor, _READ_SIZE)
        except BlockingIOError:
            return False
        except ConnectionResetError:
            data = b""
        self._content += data
        if self._header is None and b"\n" in self._content:
            line, _, rest = bytes(self._content).partition(b"\n")
            self._header, self._content = json.loads(line), bytearray(rest)
        if not data:
            self._close()
        return bool(data)

    def _close(self) -> None:
        if self._open:
            self._open = False
            self._loop.forget(self._resolver.descriptor)
            os.close(self._resolver.descriptor)

    def _exited(self) -> None:
        """What it wrote is in the pipe; whoever else holds the pipe open is not waited for."""
        while self._open and self._read():
            pass
        self._close()
        self._loop.forget(self._pidfd)
        os.close(self._pidfd)
        code = os.waitstatus_to_exitcode(os.waitpid(self._resolver.pid, 0)[1])
        self._ending = Ending(code=code) if code >= 0 else Ending(signal=-code)
