"""Whose child is whose: finds what detached itself from a process and became ours, and says to whom it belongs.

The supervisor is a subreaper, so a descendant that loses its parent becomes its child. Nothing tells us when that
happens, but whatever becomes of such a process later does: its end is a SIGCHLD. So the list of our children is read
at each SIGCHLD, at the end of a program, and when something is to be stopped; never else.
"""

from __future__ import annotations

import contextlib
import os
import signal
from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.supervise.keeping import proc
from orchestra.supervise.keeping.marks import PROCESS, RUN, number_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from orchestra.supervise.keeping.shared_memory import DeadReaders

_FOR_GROUPS = frozenset(
    {
        signal.SIGINT,
        signal.SIGTERM,
        signal.SIGHUP,
        signal.SIGQUIT,
        signal.SIGKILL,
        signal.SIGSTOP,
        signal.SIGCONT,
    }
)


@dataclass(frozen=True, slots=True)
class Adopted:
    """A descendant that became our child. `owner` is the process it belongs to, None where nothing tells."""

    pid: int
    owner: str | None
    command: str


class Kin:
    """Our children: those that we started ourselves, and those that became ours."""

    def __init__(self, run_id: str) -> None:
        self._run_id = run_id
        # Not None where a child of ours has ended by a signal, and perhaps could not clear up behind itself.
        self.dead_readers: DeadReaders | None = None
        self._numbers: dict[str, int | None] = {}
        self._own: dict[int, str | None] = {}
        self._adopted: dict[int, Adopted] = {}
        # Whether a child is a node that the fork server has forked, and that will be added with its owner.
        self.unborn: Callable[[int], bool] = lambda _pid: False

    def number(self, owner: str) -> int | None:
        """Return the number that a program of a process gets before it begins, and never loses."""
        if owner not in self._numbers:
            self._numbers[owner] = number_of(self._run_id, len(self._numbers) + 1)
        return self._numbers[owner]

    def add(self, pid: int, owner: str | None) -> None:
        """Take note of a child that we started; `owner` None for one of our own tools."""
        self._own[pid] = owner

    def remove(self, pid: int) -> None:
        """Forget a child that has ended and is about to be reaped by whoever started it."""
        del self._own[pid]
        with contextlib.suppress(ChildProcessError):
            ended = os.waitid(os.P_PID, pid, os.WEXITED | os.WNOHANG | os.WNOWAIT)
            if ended is not None and ended.si_code != os.CLD_EXITED:
                self._strike()

    def refresh(self) -> tuple[list[Adopted], list[Adopted]]:
        """Look at our children: return who is new among us, and who has ended. The latter are reaped."""
        new = []
        for pid in proc.children(os.getpid()):
            if pid not in self._own and pid not in self._adopted and not self.unborn(pid):
                self._adopted[pid] = adopted = Adopted(pid, self._owner(pid), proc.command(pid))
                new.append(adopted)
        ended = [adopted for adopted in self._adopted.values() if self._reaped(adopted.pid)]
        for adopted in ended:
            del self._adopted[adopted.pid]
        return new, ended

    def of(self, owner: str | None) -> list[Adopted]:
        """Return the living adopted descendants of a process, or those that belong to none."""
        return [adopted for adopted in self._adopted.values() if adopted.owner == owner]

    def members(self, owner: str) -> list[int]:
        """Return the programs that we started for a process, and its living adopted descendants."""
        started = [pid for pid, known in self._own.items() if known == owner]
        return [*started, *(adopted.pid for adopted in self.of(owner))]

    def owner(self, pid: int) -> str | None:
        """Tell to which process any process belongs, by its marks or by whose descendant it is; None for a stranger."""
        while pid > 1 and pid != os.getpid():
            owner = (
                self._adopted[pid].owner if pid in self._adopted else self._own.get(pid) or self._owner(pid)
            )
            if owner is not None:
                return owner
            facts = proc.stat(pid)
            pid = facts.parent if facts else 0
        return None

    def group(self, pid: int) -> int | None:
        """Return the process group of a child, None where it has gone."""
        facts = proc.stat(pid)
        return facts.group if facts else None

    def _owner(self, pid: int) -> str | None:
        """Tell by the marks, else by the session, which most share with the program, else by the number."""
        run, process = proc.marks(pid, (RUN, PROCESS))
        if run == self._run_id and process is not None:
            return process
        facts = proc.stat(pid)
        owner = self._own.get(facts.session) if facts else None
        number = None if owner else proc.lock_limit(pid)
        return owner if number is None else self._numbered(number)

    def _reaped(self, pid: int) -> bool:
        try:
            reaped, status = os.waitpid(pid, os.WNOHANG)
        except ChildProcessError:
            return True
        if reaped == pid and os.WIFSIGNALED(status):
            self._strike()
        return reaped == pid

    def _strike(self) -> None:
        """Take note of an end by a signal, and keep those that talked with the dead one from hanging for it."""
        from orchestra.supervise.keeping.shared_memory import DeadReaders  # noqa: PLC0415 - few are killed

        self.dead_readers = self.dead_readers or DeadReaders()
        self.dead_readers.close()

    def _numbered(self, number: int) -> str | None:
        return next((owner for owner, known in self._numbers.items() if known == number), None)


def send_to_groups(pids: Iterable[int], number: int) -> None:
    """Signal the process groups of children of ours that have not been reaped.

    Such a child keeps its group's number from being given to others. Stopped processes are woken, since they could not
    act on the signal otherwise; KILL needs no waking, and reaches whole trees, for it cannot be handed on.
    """
    pids = list(pids)
    for group in {os.getpgid(pid) for pid in pids if _exists(pid)} - {os.getpgrp()}:
        _quietly(os.killpg, group, number)
        if number != signal.SIGKILL:
            _quietly(os.killpg, group, signal.SIGCONT)
    if number == signal.SIGKILL:
        for pid in pids:
            for descendant in (pid, *proc.branch(pid)):
                _quietly(os.kill, descendant, number)


def send_as_asked(pid: int, number: int) -> None:
    """Send a signal to a program that leads a group, and to all of the group where a terminal does so.

    A program often has a handler for a signal that would end its children and the shell around it.
    """
    _quietly(os.killpg if number in _FOR_GROUPS else os.kill, pid, number)


def _exists(pid: int) -> bool:
    try:
        os.getpgid(pid)
    except ProcessLookupError:
        return False
    return True


def _quietly(send: Callable[[int, int], None], target: int, number: int) -> None:
    with contextlib.suppress(ProcessLookupError, PermissionError):
        send(target, number)
