"""Work shared out to processes: each is given one piece after the other, and whatever a piece does ends with it.

Rejected: `concurrent.futures`, where one process that dies takes all the work with it, and none is told how long a
piece may take.
"""

from __future__ import annotations

import os
import pickle
import selectors
import signal
import struct
import sys
import time
import traceback
from contextlib import suppress
from typing import TYPE_CHECKING, Any, Final, Generic, TypeVar

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.resolve.command_reaper import end_with_parent

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

_PieceT = TypeVar("_PieceT")
_ResultT = TypeVar("_ResultT")

_HEAD: Final = struct.Struct("!Q")


@dataclass(frozen=True, slots=True)
class Lost:
    """A piece that has no result; `reason` goes on after "the file": "has ended the process ..."."""

    reason: str


@dataclass(frozen=True, slots=True)
class Done(Generic[_ResultT]):
    """The result of one piece, which can be pickled; with `last` its process takes no other."""

    result: _ResultT
    last: bool = False


@dataclass(frozen=True, slots=True)
class _Failed:
    """What was raised where a piece was to become a result, and how."""

    told: str


@dataclass(slots=True)
class _Worker:
    pid: int
    orders: int
    answers: int
    piece: int | None = None
    deadline: float = 0.0
    received: bytearray = field(default_factory=bytearray)


class Pool(Generic[_PieceT, _ResultT]):
    """Processes that all begin with what this one has in memory.

    `begin` is called in each of them and gives what turns a piece into a result. `patience` is how long, in seconds,
    one piece may take.
    """

    def __init__(
        self, begin: Callable[[], Callable[[_PieceT], Done[_ResultT]]], workers: int, patience: float
    ) -> None:
        self._begin = begin
        self._most = workers
        self._patience = patience
        self._workers: dict[int, _Worker] = {}
        self._selector = selectors.DefaultSelector()

    def results(self, pieces: Sequence[_PieceT]) -> Iterator[tuple[int, _ResultT | Lost]]:
        """Yield the number of each piece with its result, as they come; nothing of the processes is left behind."""
        waiting = list(range(len(pieces)))[::-1]
        try:
            while waiting or any(worker.piece is not None for worker in self._workers.values()):
                self._share_out(waiting, pieces)
                yield from self._gathered()
        finally:
            for worker in list(self._workers.values()):
                self._end(worker)
            self._selector.close()

    def _share_out(self, waiting: list[int], pieces: Sequence[_PieceT]) -> None:
        idle = [worker for worker in self._workers.values() if worker.piece is None]
        while waiting and (idle or len(self._workers) < self._most):
            worker = idle.pop() if idle else self._start()
            worker.piece, worker.deadline = waiting.pop(), time.monotonic() + self._patience
            with suppress(BrokenPipeError):  # it is dead, which its answers will show
                _send(worker.orders, pieces[worker.piece])

    def _start(self) -> _Worker:
        sys.stdout.flush()
        sys.stderr.flush()
        reading, orders = os.pipe()
        answers, writing = os.pipe()
        parent, pid = os.getpid(), os.fork()
        if pid == 0:
            _work(reading, writing, self._begin, parent)
        os.close(reading)
        os.close(writing)
        worker = self._workers[answers] = _Worker(pid, orders, answers)
        self._selector.register(answers, selectors.EVENT_READ, worker)
        return worker

    def _gathered(self) -> Iterator[tuple[int, _ResultT | Lost]]:
        """Wait until something happens, and yield what has come of it."""
        deadline = min(worker.deadline for worker in self._workers.values() if worker.piece is not None)
        for key, _ in self._selector.select(max(0.0, deadline - time.monotonic())):
            worker: _Worker = key.data
            chunk = os.read(worker.answers, 1 << 20)
            if chunk:
                worker.received += chunk
                yield from self._complete(worker)
            else:
                yield from self._dead(worker)
        now = time.monotonic()
        for worker in [item for item in self._workers.values() if item.piece is not None]:
            if worker.deadline <= now and worker.piece is not None:
                self._end(worker)
                yield worker.piece, Lost(f"has not come to an end within {self._patience:g} s")

    def _complete(self, worker: _Worker) -> Iterator[tuple[int, _ResultT | Lost]]:
        size = _HEAD.unpack_from(worker.received)[0] if len(worker.received) >= _HEAD.size else None
        if size is None or len(worker.received) < _HEAD.size + size or worker.piece is None:
            return
        done: Done[_ResultT] | _Failed = pickle.loads(worker.received[_HEAD.size :])  # noqa: S301 - a fork of this
        if isinstance(done, _Failed):
            raise RuntimeError(done.told)  # noqa: TRY004 - it is what the other process has met with
        piece, worker.piece = worker.piece, None
        worker.received.clear()
        if done.last:
            self._end(worker)
        yield piece, done.result

    def _dead(self, worker: _Worker) -> Iterator[tuple[int, _ResultT | Lost]]:
        status = self._end(worker)
        if worker.piece is not None:
            yield worker.piece, Lost(f"has ended the process that was reading it ({_told(status)})")

    def _end(self, worker: _Worker) -> int:
        """Kill a process if it is still there, and return how it ended, as `waitpid` tells."""
        self._selector.unregister(worker.answers)
        del self._workers[worker.answers]
        os.close(worker.orders)
        os.close(worker.answers)
        ended, status = os.waitpid(worker.pid, os.WNOHANG)
        if ended == 0:
            os.kill(worker.pid, signal.SIGKILL)
            _, status = os.waitpid(worker.pid, 0)
        return status


def _work(orders: int, answers: int, begin: Callable[[], Callable[[Any], Done[Any]]], parent: int) -> None:
    """Turn pieces into results until there are no more. This is the life of a process of the pool."""
    status, own = 1, os.getpid()
    try:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        end_with_parent()
        if os.getppid() == parent:
            os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
            os.dup2(2, 1)
            work = begin()
            with open(orders, "rb", closefd=False) as stream:
                while head := stream.read(_HEAD.size):
                    piece = pickle.loads(stream.read(_HEAD.unpack(head)[0]))  # noqa: S301 - from the parent
                    done = work(piece)
                    if os.getpid() != own:  # code of the piece has forked, and this is the other one
                        break
                    _send(answers, done)
            status = 0
    except KeyboardInterrupt:  # raised by code of the piece: a real one ends this process at once
        status = 128 + signal.SIGINT
    except BaseException:  # noqa: BLE001 - nothing may get out of this process into code of the other one
        if os.getpid() == own:
            _send(answers, _Failed(traceback.format_exc()))
    finally:
        sys.stderr.flush()
        os._exit(status)


def _send(descriptor: int, message: object) -> None:
    body = pickle.dumps(message)
    left = memoryview(_HEAD.pack(len(body)) + body)
    while left:
        left = left[os.write(descriptor, left) :]


def _told(status: int) -> str:
    if os.WIFSIGNALED(status):
        return signal.Signals(os.WTERMSIG(status)).name
    return f"exit status {os.waitstatus_to_exitcode(status)}"
