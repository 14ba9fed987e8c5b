"""What the kernel tells of the threads of a process that hangs (proc(5)): where each of them waits."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.supervise.keeping import proc

if TYPE_CHECKING:
    from collections.abc import Iterable

# More than this tells nobody more.
_MOST = 200


@dataclass(frozen=True, slots=True)
class Thread:
    """One thread. `state` is a letter (`S` sleeps, `R` runs, `D` waits for a device, `T` and `t` are stopped).

    `wchan` is the function of the kernel in which it waits, `syscall` the number of its system call and its arguments,
    `stack` the stack in the kernel, which only the superuser may see; empty where that is not to be had.
    """

    pid: int
    tid: int
    name: str
    state: str
    wchan: str
    syscall: str
    stack: tuple[str, ...]

    def __str__(self) -> str:
        where = f" in {self.wchan}" if self.wchan else ""
        return (
            f"{self.name} (pid {self.pid}, thread {self.tid}): {_STATES.get(self.state, self.state)}{where}"
        )


_STATES = {
    "R": "runs",
    "S": "sleeps",
    "D": "waits for a device",
    "T": "is stopped",
    "t": "is stopped by a debugger",
    "Z": "has ended",
    "I": "is idle",
}


def trees(pids: Iterable[int]) -> list[int]:
    """Return some processes and all that is below them."""
    return [*dict.fromkeys(member for pid in pids for member in (pid, *proc.branch(pid)))]


def threads(pids: Iterable[int]) -> list[Thread]:
    """Return the threads of some processes, and of all below them; of one that has gone there is none."""
    found: list[Thread] = []
    for pid in trees(pids):
        try:
            tids = sorted(map(int, os.listdir(f"/proc/{pid}/task")))  # noqa: PTH208 - as in `proc`
        except OSError:
            continue
        found.extend(thread for tid in tids[: _MOST - len(found)] if (thread := _thread(pid, tid)))
    return found


def _thread(pid: int, tid: int) -> Thread | None:
    folder = f"/proc/{pid}/task/{tid}"
    stat = _text(f"{folder}/stat")
    if not stat:
        return None
    name = _text(f"{folder}/comm")
    wchan = _text(f"{folder}/wchan")
    stack = tuple(line.strip() for line in _text(f"{folder}/stack").splitlines())
    state = stat.rpartition(")")[2].split()[0]
    return Thread(pid, tid, name, state, "" if wchan == "0" else wchan, _text(f"{folder}/syscall"), stack)


def _text(path: str) -> str:
    """Return what a file says, nothing where we may not read it; none of these waits for the process."""
    try:
        with open(path, "rb") as file:  # noqa: PTH123 - as in `proc`
            return file.read().decode("utf-8", "replace").strip()
    except OSError:
        return ""
