"""The user's terminal and a process that he is attached to: bytes from one to the other, until one of them leaves."""

from __future__ import annotations

import base64
import contextlib
import os
import select
import signal
import sys
import termios
import tty
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from orchestra.cli.keys import Keys
from orchestra.cli.runs import told
from orchestra.control.client import GoneError
from orchestra.control.protocol import Refusal

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from orchestra.control.client import Client

_IN, _OUT = 0, 1
_OUTPUT_MODES = 1  # of what tcgetattr(3) gives
_READ_SIZE = 4096
# How soon typed text that the process has not taken is tried again, in seconds.
_TRY_AGAIN = 0.05
_SIGNALLED = 128
_ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT)


class Conversation:
    """One attachment at the user's terminal. Whatever ends it, the terminal is as it was before."""

    def __init__(self, client: Client, *, types: bool) -> None:
        self._client = client
        self._types = types
        self._keys = Keys()
        self._typed = b""
        self._sent: int | None = None
        self._status: int | None = None

    def hold(self) -> int:
        """Talk until somebody leaves; return the status: 0, or 128 and the number of the signal that ended it."""
        with _signals() as signals, _raw(wanted=self._types):
            sources: dict[int, Callable[[], None]] = {
                signals: lambda: self._signalled(os.read(signals, _READ_SIZE)),
                self._client.fileno(): self._heard,
            }
            if self._types:
                sources[_IN] = lambda: self._read(sources)
            while self._status is None:
                waiting = _TRY_AGAIN if self._typed and self._sent is None else None
                ready, _, _ = select.select([*sources], [], [], waiting)
                for descriptor in ready:
                    if self._status is None and descriptor in sources:
                        sources[descriptor]()
                self._send()
        return self._status

    def _read(self, sources: dict[int, Callable[[], None]]) -> None:
        try:
            data = os.read(_IN, _READ_SIZE)
        except OSError:  # the terminal has hung up
            data = b""
        if not data:
            del sources[_IN]
            return
        typed, leaves = self._keys.typed(data)
        self._typed += typed
        if leaves:
            self._leave(0, "left; the process goes on")

    def _send(self) -> None:
        """Send what is typed, one piece at a time: what the process does not take stays here."""
        if self._typed and self._sent is None and self._status is None:
            piece = self._typed[:_READ_SIZE]
            self._sent = self._client.send("input", data=base64.b64encode(piece).decode())

    def _heard(self) -> None:
        try:
            messages = self._client.arrived()
        except GoneError:
            self._leave(0, "the run has ended")
            return
        for message in messages:
            self._take(message)

    def _take(self, message: dict[str, Any]) -> None:
        if "output" in message:
            if message["missed"]:
                told(f"\n[orchestra] {message['missed']} bytes are not shown: they came too fast")
            _write(base64.b64decode(message["output"]))
        elif "detached" in message:
            self._leave(0, f"the process has ended: {message['detached']}")
        elif message.get("id") == self._sent and self._sent is not None:
            self._sent = None
            if "error" in message and self._status is None:
                raise Refusal(message["error"]["code"], message["error"]["message"])
            self._typed = self._typed[message.get("result", {}).get("taken", 0) :]

    def _signalled(self, numbers: bytes) -> None:
        for number in numbers:
            if number == signal.SIGWINCH:
                self._resize()
            elif self._status is None:
                self._status = 0 if number == signal.SIGINT and not self._types else _SIGNALLED + number

    def _resize(self) -> None:
        with contextlib.suppress(OSError):
            columns, lines = os.get_terminal_size(_OUT)
            self._client.send("resize", columns=max(1, columns), lines=max(1, lines))

    def _leave(self, status: int, why: str) -> None:
        if self._status is None:
            self._status = status
            told(f"\n[orchestra] {why}" if self._types else f"[orchestra] {why}")


def _write(data: bytes) -> None:
    view = memoryview(data)
    while view:
        view = view[os.write(_OUT, view) :]


@contextmanager
def _raw(*, wanted: bool) -> Iterator[None]:
    """Hand every key to the process, and give the terminal its modes back in the end.

    What is shown goes through the terminal as before: that of a process puts no carriage return before a line feed.
    """
    if not wanted or not sys.stdin.isatty():
        yield
        return
    before = termios.tcgetattr(_IN)
    tty.setraw(_IN)
    modes = termios.tcgetattr(_IN)
    modes[_OUTPUT_MODES] = before[_OUTPUT_MODES]
    termios.tcsetattr(_IN, termios.TCSADRAIN, modes)
    try:
        yield
    finally:
        with contextlib.suppress(termios.error):  # it has hung up
            termios.tcsetattr(_IN, termios.TCSADRAIN, before)


@contextmanager
def _signals() -> Iterator[int]:
    """Receive signals as bytes instead of ending by them, for the terminal has to be given back first."""
    readable, writable = os.pipe()
    os.set_blocking(writable, False)
    before = signal.set_wakeup_fd(writable, warn_on_full_buffer=False)
    handlers = {number: signal.signal(number, _only_wake) for number in (*_ENDING, signal.SIGWINCH)}
    try:
        yield readable
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)
        signal.set_wakeup_fd(before)
        os.close(readable)
        os.close(writable)


def _only_wake(_number: int, _frame: object) -> None:
    """Do nothing: that a handler exists makes the interpreter write the byte."""
