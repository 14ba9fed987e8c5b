"""The supervisor's side of the connection to a resolver that stays: one question at a time, the others wait here.

Nothing waits for the resolver but the triggers that it decides about: what is written to it goes out as it takes it,
and questions about output, of which there may be many, are dropped where too many wait. A resolver that dies or does
not answer in time is a failure of every question that is open, and of every later one.
"""

from __future__ import annotations

import json
import os
import signal
from collections import deque
from typing import TYPE_CHECKING, Any, NamedTuple

from orchestra.supervise.keeping.kin import send_to_groups
from orchestra.supervise.output.outbox import Outbox
from orchestra.supervise.process.ending import Ending

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.supervise.keeping.kin import Kin
    from orchestra.supervise.loop import Loop, Timer
    from orchestra.supervise.reactions.fragment import Failure, Fragment
    from orchestra.supervise.resolver.process import Resolver

# What may wait here in questions that can be dropped, in bytes.
BACKLOG = 4 * 1024 * 1024
# While the run ends, an answer is awaited for so long, in seconds.
PATIENCE_AT_THE_END = 1.0
_LEAVE_WITHIN = 0.5
_READ_SIZE = 65536
_GONE = "the resolver, which runs the code of the launch files, has ended"


class _Question(NamedTuple):
    line: bytes
    answered: Callable[[Fragment | Failure], None]


class Questions:
    """Asks the resolver what only code of the description knows. `limit` is in seconds, for each answer.

    `resolver` is None where none stayed.
    """

    def __init__(self, resolver: Resolver | None, loop: Loop, kin: Kin, limit: float) -> None:
        self._loop = loop
        self._kin = kin
        self._limit = limit
        self._waiting: deque[_Question] = deque()
        self._size = 0
        self._current: _Question | None = None
        self._abandoned = False
        self._received = bytearray()
        self._outbox: Outbox | None = None
        self._timer: Timer | None = None
        self._gone: str | None = _GONE
        self._pid: int | None = None
        self._reading = False
        if resolver:
            self._connect(resolver)

    def _connect(self, resolver: Resolver) -> None:
        self._gone = None
        self._pid = resolver.pid
        self._pidfd = os.pidfd_open(resolver.pid)
        self._reader = resolver.descriptor
        # One descriptor cannot be waited for twice. That it takes nothing any more, its pidfd tells.
        self._outbox = Outbox(self._loop, os.dup(resolver.descriptor), lambda _error: None)
        self._kin.add(resolver.pid, None)
        self._loop.on_readable(self._pidfd, self._ended)
        self._loop.on_readable(self._reader, self._read)
        self._reading = True

    @property
    def pending(self) -> bool:
        """Whether somebody waits for an answer."""
        return bool(self._waiting) or (self._current is not None and not self._abandoned)

    @property
    def pid(self) -> int | None:
        """The pid of the resolver until it has been reaped."""
        return self._pid

    @property
    def alive(self) -> bool:
        """Whether the resolver has not been reaped."""
        return self._pid is not None

    def ask(
        self, question: dict[str, Any], answered: Callable[[Fragment | Failure], None], *, droppable: bool
    ) -> bool:
        """Ask when those before have been answered; where nobody is there, `answered` hears so at once.

        False where the question was dropped.
        """
        if self._gone is not None:
            answered(_failure(self._gone))
            return True
        line = json.dumps(question).encode() + b"\n"
        if droppable and self._size + len(line) > BACKLOG:
            return False
        self._size += len(line)
        self._waiting.append(_Question(line, answered))
        self._next()
        return True

    def hurry(self) -> None:
        """The run ends: who waits now waits in vain, and later questions have little time."""
        self._limit = min(self._limit, PATIENCE_AT_THE_END)
        abandoned = [*self._waiting]
        self._waiting.clear()
        self._size = 0
        if self._current and not self._abandoned:
            abandoned.insert(0, self._current)
            self._abandoned = True
            self._set_timer()
        for question in abandoned:
            question.answered(_failure("the run ended before the answer", abandoned=True))

    def leave(self) -> None:
        """Let the resolver end; it is killed where it does not."""
        if self._gone is None:
            self._disconnect("the run is over")
            self._loop.call_later(_LEAVE_WITHIN, self._kill)

    def _next(self) -> None:
        if self._current or not self._waiting or self._outbox is None:
            return
        self._current = self._waiting.popleft()
        self._abandoned = False
        self._size -= len(self._current.line)
        self._set_timer()
        self._outbox.send(self._current.line)

    def _read(self) -> bool:
        """Read once; tell whether there was something. Its end of the connection closes with it: `_ended` tells."""
        try:
            data = os.read(self._reader, _READ_SIZE)
        except BlockingIOError:
            return False
        except ConnectionResetError:
            data = b""
        if not data:
            self._stop_reading()
            self._kill()
            return False
        self._received += data
        while b"\n" in data and self._current:
            line, _, data = bytes(self._received).partition(b"\n")
            self._received = bytearray(data)
            self._take(line)
        return True

    def _take(self, line: bytes) -> None:
        question, abandoned = self._current, self._abandoned
        self._current = None
        self._cancel_timer()
        if question and not abandoned:
            from orchestra.supervise.reactions.fragment import loads  # noqa: PLC0415 - as below

            question.answered(loads(line))
        self._next()

    def _expired(self) -> None:
        self._disconnect(f"the code of the launch file did not answer within {self._limit:g} s")
        self._kill()

    def _kill(self) -> None:
        if self._pid is not None:
            send_to_groups([self._pid], signal.SIGKILL)

    def _ended(self) -> None:
        """Its last answer may still be on its way to us."""
        if self._pid is None:
            return
        while self._reading and self._read():
            pass
        ending = os.waitstatus_to_exitcode(os.waitpid(self._pid, 0)[1])
        self._loop.forget(self._pidfd)
        os.close(self._pidfd)
        self._kin.remove(self._pid)
        self._pid = None
        shown = Ending(code=ending) if ending >= 0 else Ending(signal=-ending)
        self._disconnect(f"{_GONE} ({shown})")

    def _disconnect(self, reason: str) -> None:
        """Close the connection; every open question fails."""
        if self._gone is not None:
            return
        self._gone = reason
        self._cancel_timer()
        self._stop_reading()
        os.close(self._reader)
        if self._outbox:
            self._outbox.close()
            self._outbox = None
        open_questions = [*([self._current] if self._current and not self._abandoned else []), *self._waiting]
        self._current = None
        self._waiting.clear()
        for question in open_questions:
            question.answered(_failure(reason))

    def _stop_reading(self) -> None:
        if self._reading:
            self._reading = False
            self._loop.forget(self._reader)

    def _set_timer(self) -> None:
        self._cancel_timer()
        self._timer = self._loop.call_later(self._limit, self._expired)

    def _cancel_timer(self) -> None:
        if self._timer:
            self._timer.cancel()
            self._timer = None


def _failure(reason: str, *, abandoned: bool = False) -> Failure:
    from orchestra.supervise.reactions.fragment import Failure  # noqa: PLC0415 - few runs have a resolver that stays

    return Failure(reason, abandoned=abandoned)
