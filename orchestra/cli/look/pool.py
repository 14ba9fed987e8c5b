"""Work shared out to processes: each is given some pieces after the others, and whatever a piece does ends with it.

Rejected: `concurrent.futures`, where one process that dies takes all the work with it, and none is told how long a
piece may take.
"""

from __future__ import annotations

import mmap
import os
import selectors
import signal
import sys
import time
from contextlib import suppress
from typing import TYPE_CHECKING, Any, Final

from orchestra.cli.look.shares import Shares
from orchestra.cli.look.worker import Channels, received, send, work
from orchestra.dataclass import dataclass
from orchestra.fields import field

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from orchestra.cli.look.worker import Work

_CHUNK: Final = 1 << 16
_PATIENCE: Final = 5.0  # seconds for what a process has left to do


@dataclass(frozen=True, slots=True)
class Lost:
    """A piece that has no result; `reason` goes on after "the file": "has ended the process ..."."""

    reason: str


@dataclass(slots=True)
class _Worker:
    """A process; `pieces` are those that it was given, of which nothing has been heard yet.

    One that `is_ending` takes no more.
    """

    number: int
    pid: int
    channels: Channels
    pieces: list[int] = field(default_factory=list)
    is_ending: bool = False
    since: float = 0.0
    received: bytearray = field(default_factory=bytearray)

    @property
    def piece(self) -> int:
        """The one that it is working on."""
        return self.pieces[min(int(self.channels.progress[0]), len(self.pieces) - 1)]


class Pool:
    """Processes that all begin with what this one has in memory.

    `begin` is called in each of them and gives what turns the number of a piece into a result. `patience` is how long,
    in seconds, one piece may take.
    """

    def __init__(self, begin: Callable[[], Work], workers: int, patience: float) -> None:
        self._begin = begin
        self._most = workers
        self._patience = patience
        self._workers: dict[int, _Worker] = {}
        self._selector = selectors.DefaultSelector()

    def results(self, pieces: int) -> Iterator[tuple[int, Any]]:
        """Yield the number of each of so many pieces with its result, or why it is `Lost`, as they come.

        Nothing of the processes is left behind.
        """
        shares = Shares(pieces, self._most)
        try:
            while shares.left or any(worker.pieces for worker in self._workers.values()):
                self._share_out(shares)
                yield from self._gathered(shares)
            self._wait()
        finally:
            self._end(*self._workers.values())
            self._selector.close()

    def _share_out(self, shares: Shares) -> None:
        there = {worker.number: worker for worker in self._workers.values() if not worker.is_ending}
        for number in range(self._most):
            worker = there.get(number)
            if worker is not None and not worker.pieces and not shares.left:
                _let_go(worker)
            elif (worker is None or not worker.pieces) and shares.left:
                worker = worker or self._start(number)
                worker.pieces, worker.since = shares.take(number), time.monotonic()
                worker.channels.progress[0], worker.channels.progress[1] = 0, worker.since
                with suppress(BrokenPipeError):  # it is dead, which its answers will show
                    send(worker.channels.orders, worker.pieces)

    def _start(self, number: int) -> _Worker:
        sys.stdout.flush()
        sys.stderr.flush()
        reading, orders = os.pipe()
        answers, writing = os.pipe()
        progress = memoryview(mmap.mmap(-1, mmap.PAGESIZE)).cast("d")
        parent, pid = os.getpid(), os.fork()
        if pid == 0:
            work(Channels(reading, writing, progress), self._begin, parent)
        os.close(reading)
        os.close(writing)
        worker = self._workers[answers] = _Worker(number, pid, Channels(orders, answers, progress))
        self._selector.register(answers, selectors.EVENT_READ, worker)
        return worker

    def _gathered(self, shares: Shares) -> Iterator[tuple[int, Any]]:
        """Wait until something happens, and yield what has come of it."""
        for key, _ in self._selector.select(max(0.0, self._deadline() - time.monotonic())):
            worker: _Worker = key.data
            if _hears(worker):
                yield from self._complete(worker, shares)
            else:
                yield from self._dead(worker, shares)
        late = time.monotonic() - self._patience
        for worker in [item for item in self._workers.values() if item.pieces]:
            if worker.channels.progress[1] <= late:
                self._end(worker)
                yield self._lost(worker, shares, f"has not come to an end within {self._patience:g} s")

    def _deadline(self) -> float:
        """Return when the first of them will have taken too long."""
        busy = (worker.channels.progress[1] for worker in self._workers.values() if worker.pieces)
        return min(busy) + self._patience

    def _complete(self, worker: _Worker, shares: Shares) -> Iterable[tuple[int, Any]]:
        """Return what a process has answered, if all of that has come."""
        answer = _answer_of(worker)
        if answer is None:
            return ()
        pieces, results = worker.pieces, answer["results"]
        worker.pieces = []
        shares.took(worker.number, time.monotonic() - worker.since)
        shares.put_back(worker.number, pieces[len(results) :])
        if answer["last"]:
            self._end(worker)
        return zip(pieces, results, strict=False)

    def _wait(self) -> None:
        """Let processes do what is left, and end by themselves."""
        for worker in self._workers.values():
            if not worker.is_ending:
                _let_go(worker)
        deadline = time.monotonic() + _PATIENCE
        while self._workers and (seconds := deadline - time.monotonic()) > 0:
            for key, _ in self._selector.select(seconds):
                if _hears(key.data):
                    _answer_of(key.data)
                else:
                    self._end(key.data)

    def _dead(self, worker: _Worker, shares: Shares) -> Iterator[tuple[int, Any]]:
        status = self._end(worker)
        if worker.pieces:
            told = f"has ended the process that was reading it ({_told(status)})"
            yield self._lost(worker, shares, told)

    def _lost(self, worker: _Worker, shares: Shares, reason: str) -> tuple[int, Lost]:
        """Return what is to be said of the piece that a process was lost with; the others are done again."""
        lost = worker.piece
        shares.put_back(worker.number, [piece for piece in worker.pieces if piece != lost])
        return lost, Lost(reason)

    def _end(self, *workers: _Worker) -> int:
        """Kill processes if they are still there, and return how the last one ended, as `waitpid` tells."""
        status, left = 0, []
        for worker in workers:
            self._selector.unregister(worker.channels.answers)
            del self._workers[worker.channels.answers]
            os.close(worker.channels.orders)
            os.close(worker.channels.answers)
            ended, status = os.waitpid(worker.pid, os.WNOHANG)
            if ended == 0:
                os.kill(worker.pid, signal.SIGKILL)
                left.append(worker.pid)
        for pid in left:
            _, status = os.waitpid(pid, 0)
        return status


def _let_go(worker: _Worker) -> None:
    """Let a process do what it has left, and end by itself."""
    worker.is_ending = True
    with suppress(BrokenPipeError):  # it is dead, and there is nothing left for it
        send(worker.channels.orders, [])


def _hears(worker: _Worker) -> bool:
    """Take what a process has sent; tell whether it is still there."""
    chunk = os.read(worker.channels.answers, _CHUNK)
    worker.received += chunk
    return bool(chunk)


def _answer_of(worker: _Worker) -> dict[str, Any] | None:
    """Return what a process has answered, if all of that has come. Raises `RuntimeError` for what it has met with."""
    answer: dict[str, Any] | None = received(worker.received)
    if answer is not None:
        worker.received.clear()
        if "failed" in answer:
            raise RuntimeError(answer["failed"])
    return answer


def _told(status: int) -> str:
    if os.WIFSIGNALED(status):
        return signal.Signals(os.WTERMSIG(status)).name
    return f"exit status {os.waitstatus_to_exitcode(status)}"
