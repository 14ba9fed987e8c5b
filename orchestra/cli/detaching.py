"""A run that outlives the command that starts it, and the terminal.

The command forks what becomes the keeper, in a session of its own, with hang-ups ignored and its standard streams on a
file. That file lies beside the run directories until there is one for it: then it is `console.log` in there. Whatever
goes wrong before that is shown by the command, whose status it is.
"""

from __future__ import annotations

import os
import select
import signal
import sys
from contextlib import suppress

TYPE_CHECKING = False  # `typing` itself costs more than this module, which the keeper carries
if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.supervise.attendance import Attend, Attendant
    from orchestra.supervise.operation import Operation
    from orchestra.supervise.surroundings import Surroundings

CONSOLE = "console.log"
# What a name beside the run directories begins with while no run directory is there; the pid of the command follows.
BEGINNING = ".begins-"
_SIGNALLED = 128


class Console:
    """The file that takes the place of the terminal, as the command reads it."""

    def __init__(self, runs: str) -> None:
        os.makedirs(runs, exist_ok=True)  # noqa: PTH103 - pathlib is slow to import and this runs in the keeper
        self.path = f"{runs}/{BEGINNING}{os.getpid()}"
        flags = os.O_RDWR | os.O_APPEND | os.O_CREAT | os.O_TRUNC | os.O_CLOEXEC | os.O_NOFOLLOW
        self.descriptor = os.open(self.path, flags, 0o600)
        self._shown = 0

    def show(self) -> None:
        """Show what is new."""
        while data := os.pread(self.descriptor, 65536, self._shown):
            self._shown += len(data)
            sys.stderr.buffer.write(data)
        sys.stderr.buffer.flush()

    def remove(self) -> None:
        """Remove the file where no run has taken it."""
        if os.path.exists(self.path):  # noqa: PTH110 - as above
            os.unlink(self.path)  # noqa: PTH108 - as above


def detached(runs: str, start: Callable[[Callable[[Attend], Attend]], int], *, wait_ready: bool) -> int:
    """Let `start` run in a process of its own and return the status of the command.

    `start` is given what it has to do to the function that attends to its run, so that its begin is told. Its status is
    ours where it ends before that, or before it is ready where `wait_ready` asks for it. Raises `OSError`.
    """
    console = Console(runs)
    heard, told = os.pipe()
    for stream in (sys.stdout, sys.stderr):
        stream.flush()
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    pid = os.fork()
    if not pid:
        os.close(heard)
        _begin(start, console, told, mask)
    os.close(told)
    keeper = os.pidfd_open(pid)
    interrupts = _handed_on(keeper)
    signal.pthread_sigmask(signal.SIG_SETMASK, mask)
    try:
        status = _accompany(heard, keeper, console, wait_ready=wait_ready)
        return _status(pid) if status is None or interrupts else status
    finally:
        console.show()
        console.remove()


def _handed_on(keeper: int) -> list[int]:
    """Hand every Ctrl-C on, as a terminal would; return the list of those that come.

    An exception would be lost where it is raised in a call that the interpreter makes by itself, as imports have them.
    """
    seen: list[int] = []

    def hand_on(number: int, _: object) -> None:
        seen.append(number)
        with suppress(ProcessLookupError):  # it has ended by itself
            signal.pidfd_send_signal(keeper, number)

    signal.signal(signal.SIGINT, hand_on)
    return seen


def _begin(
    start: Callable[[Callable[[Attend], Attend]], int],
    console: Console,
    told: int,
    mask: set[int | signal.Signals],
) -> None:
    """Become the keeper of the run; this does not return."""
    status = 3
    try:
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        os.setsid()
        signal.signal(signal.SIGHUP, signal.SIG_IGN)
        nothing = os.open(os.devnull, os.O_RDONLY)
        for descriptor, number in ((nothing, 0), (console.descriptor, 1), (console.descriptor, 2)):
            os.dup2(descriptor, number)
        os.close(nothing)
        os.close(console.descriptor)
        status = start(lambda attend: _announcing(attend, console.path, told))
    finally:
        os._exit(status)


def _announcing(attend: Attend, console: str, told: int) -> Attend:
    """Return what attends to the run as `attend` does, and tells the command where it has begun."""

    def announced(around: Surroundings, operation: Operation, run: str, keeper: int) -> Attendant:
        attendant = attend(around, operation, run, keeper)
        try:
            os.rename(console, f"{around.folder}/{CONSOLE}")  # noqa: PTH104 - as above
        except OSError as error:
            around.journal.say(f"{CONSOLE} stays where it is: {error.strerror}: {console}")
        try:
            os.write(told, os.fsencode(around.folder))
        except OSError as error:  # the command has been killed; the run goes on without it
            around.journal.note(f"nobody was told that this run began: {error.strerror}")
        os.close(told)
        return attendant

    return announced


def _accompany(heard: int, keeper: int, console: Console, *, wait_ready: bool) -> int | None:
    """Wait until the run has begun, or is ready, and tell its name; return None where it ended before."""
    poll = select.poll()
    poll.register(heard, select.POLLIN)
    poll.register(keeper, select.POLLIN)
    poll.poll()
    directory = os.read(heard, 65536) if _readable(heard) else b""
    if not directory:
        return None
    from orchestra.cli.readiness import begun  # noqa: PLC0415 - only the command needs it, and only now

    return begun(os.fsdecode(directory), console.show, wait_ready=wait_ready)


def _readable(descriptor: int) -> bool:
    poll = select.poll()
    poll.register(descriptor, select.POLLIN)
    return bool(poll.poll(0))


def _status(pid: int) -> int:
    """Wait for the end of the keeper and return its status, as a shell does where a signal ended it."""
    code = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
    return code if code >= 0 else _SIGNALLED - code
