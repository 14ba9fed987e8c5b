"""One start by the fork server, from the request until the program runs or is known not to."""

from __future__ import annotations

import _socket
import contextlib
import json
import os
import signal
from typing import TYPE_CHECKING, Protocol

from orchestra.supervise.process import outputs
from orchestra.supervise.process.spawn import watched

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.plan.model import Process
    from orchestra.supervise.loop import Loop
    from orchestra.supervise.process.child import Child
    from orchestra.supervise.process.spec import Spec

_LONGEST = 65536  # bytes of what a node says instead of beginning
_GO = b"g"


class Told(Protocol):
    """Who wants to know what becomes of a start: it has `begun` or has `failed`, once."""

    def begun(self, child: Child, spec: Spec) -> None:
        """The program runs."""

    def cold(self, reason: str) -> None:
        """It will be started cold, although the plan says otherwise."""

    def failed(self, error: OSError) -> None:
        """It cannot be started, neither way."""


class Start:
    """A start under way. It owns the ends of the output, and the socket on which the node waits, until it is over."""

    def __init__(
        self,
        loop: Loop,
        process: Process,
        spec: Spec,
        told: Told,
        *,
        over: Callable[[], None],
        cold: Callable[[str], None],
    ) -> None:
        """Make the ends of its output. Raises `OSError`.

        `over` is called when it is over, before `told` hears of it; `cold` starts it cold, for a reason.
        """
        self.process = process
        self.spec = spec
        self.pid: int | None = None
        self.since = loop.clock()  # that it is asked for, or that its process is there
        self.withdrawn = False
        self._loop = loop
        self._told = told
        self._over = over
        self._cold = cold
        with contextlib.ExitStack() as kept:
            ends = kept.enter_context(outputs.opened(spec))
            ours, theirs = _socket.socketpair(_socket.AF_UNIX, _socket.SOCK_STREAM)
            self._go: _socket.socket | None = ours
            kept.callback(theirs.close)
            ours.setblocking(False)
            read = outputs.input_of(spec, ends)
            inner = (theirs.fileno(), *ends.inner, *(() if read is None else (read,)))
            self.descriptors: tuple[int, ...] = inner
            self._outer = ends.outer
            self._theirs = kept.pop_all()

    def sent(self) -> None:
        """Its descriptors are on their way: ours of them are closed."""
        self._theirs.close()

    def there(self, pid: int) -> None:
        """Its process is there: let it begin."""
        self.pid, self.since = pid, self._loop.clock()
        if self._go is None:
            return
        self._loop.on_readable(self._go.fileno(), self._answered)
        with contextlib.suppress(OSError):  # it has been killed: then it is the end of the stream that tells
            self._go.send(_GO)

    def give_up(self, reason: str) -> None:
        """Start it cold; a process that is there is ended."""
        if self._go is not None:
            self._withdraw()
            self._cold(reason)

    def cancel(self, error: OSError) -> None:
        """Do not start it at all."""
        if self._go is not None:
            self._withdraw()
            self._told.failed(error)

    def _answered(self) -> None:
        if self._go is None or self.pid is None:
            return
        try:
            answer = self._go.recv(_LONGEST)
        except BlockingIOError:
            return
        except OSError:
            answer = b""
        if answer:
            self._refused(json.loads(answer))
            return
        self._close()
        self._over()
        try:
            child = watched(self.pid, self._outer, tty=self.spec.tty)
        except OSError as error:
            self._close_outer()
            self._told.failed(error)
            return
        self._told.begun(child, self.spec)

    def _refused(self, answer: list[object] | dict[str, str]) -> None:
        self._withdraw()
        if isinstance(answer, dict):
            self._cold(answer["cold"])
        else:
            number, text, file = answer
            self._told.failed(OSError(number, text, file) if file else OSError(number, text))

    def _withdraw(self) -> None:
        self._close()
        self._close_outer()
        self.withdrawn = True
        if self.pid is not None:
            os.kill(self.pid, signal.SIGKILL)  # it stays ours until it is reaped
        self._over()
        if self.pid is not None:
            os.waitpid(self.pid, 0)

    def _close(self) -> None:
        self._theirs.close()
        if self._go is not None:
            if self.pid is not None:
                self._loop.forget(self._go.fileno())
            self._go.close()
            self._go = None

    def _close_outer(self) -> None:
        for descriptor in self._outer.values():
            os.close(descriptor)
