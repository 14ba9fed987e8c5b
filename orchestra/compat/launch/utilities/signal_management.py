"""Signals for event loops."""

from __future__ import annotations

import os
import signal
import socket
from contextlib import ExitStack
from typing import TYPE_CHECKING, Self

if TYPE_CHECKING:
    import asyncio
    from collections.abc import Callable
    from types import TracebackType

_AT_ONCE = 4096


class AsyncSafeSignalManager:
    """Hands signals to handlers within an event loop, for as long as it is entered, and again if entered again.

    It listens by `signal.set_wakeup_fd`, so it sees the signals that have a Python handler, which it leaves alone;
    whoever listened before hears them too. Entering it raises `ValueError` outside the main thread.
    """

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        self._loop = loop
        self._handlers: dict[int, Callable[[int], object]] = {}
        self._entered = ExitStack()
        self._receiver: socket.socket | None = None
        self._listener = -1

    def __enter__(self) -> Self:
        with ExitStack() as stack:
            receiver, sender = (stack.enter_context(end) for end in socket.socketpair())
            receiver.setblocking(False)
            sender.setblocking(False)
            self._listener = signal.set_wakeup_fd(sender.fileno(), warn_on_full_buffer=False)
            stack.callback(signal.set_wakeup_fd, self._listener)
            self._receiver = receiver
            self._loop.add_reader(receiver, self._receive)
            stack.callback(self._loop.remove_reader, receiver)
            self._entered = stack.pop_all()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._entered.close()
        self._receiver = None

    def handle(
        self, signum: signal.Signals | int, handler: Callable[[int], object] | None
    ) -> Callable[[int], object] | None:
        """Let a handler take a signal, None: nobody; return who took it before.

        Raises `ValueError` for what is no signal or cannot be called.
        """
        number = signal.Signals(signum)
        if handler is not None and not callable(handler):
            raise ValueError(f"a signal handler must be callable, not {handler!r}")
        before = self._handlers.pop(number, None)
        if handler is not None:
            self._handlers[number] = handler
        return before

    def _receive(self) -> None:
        assert self._receiver is not None  # noqa: S101 - it reads only while it is entered
        numbers = self._receiver.recv(_AT_ONCE)
        for number in numbers:
            handler = self._handlers.get(number)
            if handler is not None:
                handler(number)
        if numbers and self._listener != -1:
            os.write(self._listener, numbers)
