"""How every process of a run can be told: by variables in its environment, and by a number that it cannot lose.

A program that clears its environment, detaches itself and leaves its session has nothing of the first left. The soft
limit on file locks passes through all of that (getrlimit(2), execve(2)) and has meant nothing to the kernel since Linux
2.4.25, so it holds a number: the time at which the run began, and which process of the plan it was.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

RUN = "ORCHESTRA_RUN"
PROCESS = "ORCHESTRA_PROCESS"

# So many bits number the processes of a run, and so many more the run; together less than a limit has.
_PROCESS_BITS, _RUN_BITS = 20, 40
_MICROSECOND = 1000


def run_mark(nanoseconds: int, keeper: int) -> str:
    """Return the mark of a run that begins at a time, in nanoseconds since the epoch, below a keeper."""
    return f"{nanoseconds:x}-{keeper}"


def folder_prefix(run: str) -> str:
    """Return how the names of temporary folders begin that are made for a run before it has a directory."""
    return f"orchestra-{run}-"


def number_of(run: str, process: int = 0) -> int | None:
    """Return the number of the n-th process of a run, from 1, 0 for our own; None where the mark is not a run's."""
    began, _, _ = run.partition("-")
    try:
        microseconds = int(began, 16) // _MICROSECOND
    except ValueError:
        return None
    return (microseconds % (1 << _RUN_BITS)) << _PROCESS_BITS | process % (1 << _PROCESS_BITS)


def run_of(number: int, runs: Iterable[str]) -> str | None:
    """Return which of some runs a number is of."""
    for run in runs:
        first = number_of(run)
        if first is not None and first >> _PROCESS_BITS == number >> _PROCESS_BITS:
            return run
    return None
