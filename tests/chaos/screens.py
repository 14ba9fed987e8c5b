"""Who sits before a run: a file, somebody at a terminal who reads or does not, a pipe that is full or closed."""

from __future__ import annotations

import contextlib
import fcntl
import os
import pty
import signal
import subprocess
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pathlib import Path

    from tests.chaos.cases import Screen


class Audience:
    """The other side of a run's standard streams."""

    def __init__(self, screen: Screen, folder: Path) -> None:
        self._reads = screen == "terminal"
        self._transcript = folder / "screen"
        self._transcript.touch()
        self._at_terminal = screen in ("terminal", "blocked terminal")
        self._side: int | None = None
        if self._at_terminal:
            self._side, self._theirs = pty.openpty()
        elif screen == "file":
            self._theirs = os.open(self._transcript, os.O_WRONLY | os.O_APPEND)
        else:
            self._side, self._theirs = os.pipe()
        if self._side is not None:
            os.set_blocking(self._side, False)
        if screen == "closed pipe":
            self.leave()
        if screen == "full pipe":
            _fill(self._theirs)

    def begin(self, command: tuple[str, ...], environment: dict[str, str]) -> subprocess.Popen[bytes]:
        """Start the run before this audience."""
        stdin = self._theirs if self._at_terminal else subprocess.DEVNULL
        terminal: dict[str, Any] = {"preexec_fn": self._take_terminal} if self._at_terminal else {}
        popen = subprocess.Popen(
            command, env=environment, stdin=stdin, stdout=self._theirs, stderr=self._theirs, **terminal
        )
        os.close(self._theirs)
        return popen

    def _take_terminal(self) -> None:
        os.setsid()
        signal.pthread_sigmask(signal.SIG_SETMASK, ())
        os.close(os.open(os.ttyname(self._theirs), os.O_RDWR))

    def watch(self) -> None:
        """Read what is there, if this is an audience that reads."""
        if self._side is not None and self._reads:
            with contextlib.suppress(OSError), self._transcript.open("ab") as file:
                while data := os.read(self._side, 65536):
                    file.write(data)

    def type(self, keys: bytes) -> bool:
        """Press keys; tell whether there is a keyboard."""
        if self._side is None or not self._at_terminal:
            return False
        with contextlib.suppress(BlockingIOError):
            os.write(self._side, keys)
        return True

    def leave(self) -> bool:
        """Hang up; tell whether there was anything to hang up."""
        if self._side is None:
            return False
        self.watch()
        os.close(self._side)
        self._side = None
        return True

    def report(self) -> str:
        """Return what has been seen; an audience that has not looked looks now."""
        self._reads = True
        self.watch()
        return self._transcript.read_text("utf-8", "replace")


def _fill(descriptor: int) -> None:
    """Leave no room in a pipe. Afterwards it blocks again, for whoever shares it."""
    fcntl.fcntl(descriptor, fcntl.F_SETPIPE_SZ, 4096)
    os.set_blocking(descriptor, False)
    with contextlib.suppress(BlockingIOError):
        while True:
            os.write(descriptor, b"full\n" * 10)
    os.set_blocking(descriptor, True)
