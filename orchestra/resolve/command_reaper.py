"""Runs one command and ends everything it leaves behind; `commands` starts this file as a script of its own.

Its argument is the descriptor to report on, with lines `failed REASON` or `status N`. Standard input brings the
command's words and its environment, marshalled, and then stays open as long as the command may run.

This process is a subreaper, so whatever the command starts, detached or not, is its child sooner or later, and nothing
else ever is. Doing this in the caller would make the caller inherit the orphans of everything else it runs, and tell
them apart by guessing; it does so only where this process has been killed. Following descent from outside loses a
daemon as soon as its parent has ended.

Every import here delays the command, so there are few: json and typing alone would double the time.
"""

from __future__ import annotations

import _signal as signal  # type: ignore[import-not-found] # `signal` makes enumerations, which takes longer than this
import marshal
import os
import sys

_PR_SET_PDEATHSIG = 1
_PR_SET_CHILD_SUBREAPER, _PR_GET_CHILD_SUBREAPER = 36, 37
_CONTROL = 0
_NOT_STARTED = 127


def main() -> None:
    """Run the ordered command to its end or until the caller lets go, end what is left, report."""
    report = int(sys.argv[1])
    os.set_inheritable(report, False)
    # Where the caller ignores it, there would be no status to wait for.
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    # A traceback would look like words of the command.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    set_subreaper(1)
    argv, environment = marshal.load(sys.stdin.buffer)  # noqa: S302 - the caller is this same program
    leader = os.fork()
    if leader == 0:
        _become(argv, environment, report)
    status = _status(leader)
    _end_children()
    if status is not None:
        os.write(report, b"status %d\n" % status)


def _become(argv: list[str], environment: dict[str, str], report: int) -> None:
    """Turn into the command: a session of its own, no input, signals as they are by default."""
    try:
        os.setsid()
        end_with_parent()
        os.dup2(os.open(os.devnull, os.O_RDONLY), _CONTROL)
        for number in range(1, signal.NSIG):
            if signal.getsignal(number) == signal.SIG_IGN:
                signal.signal(number, signal.SIG_DFL)
        signal.pthread_sigmask(signal.SIG_SETMASK, ())
        os.execvpe(argv[0], argv, environment)  # noqa: S606 - without a shell is the point
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        os.write(report, f"failed {reason}\n".encode())
    finally:
        os._exit(_NOT_STARTED)


def _status(leader: int) -> int | None:
    """Wait for the command; the negative signal number where one ended it, None where the caller let go first."""
    import select  # noqa: PLC0415 - only here, and not where this is imported

    ended = os.pidfd_open(leader)
    poll = select.poll()
    poll.register(ended, select.POLLIN)
    poll.register(_CONTROL, select.POLLIN | select.POLLHUP)
    if ended not in dict(poll.poll()):
        return None
    return os.waitstatus_to_exitcode(os.waitpid(leader, 0)[1])


def _end_children() -> None:
    """Kill all children, and those that become children because of it, until there are none."""
    while True:
        try:
            ended, _ = os.waitpid(-1, os.WNOHANG)
            if ended:
                continue
            for child in children():
                kill(child)
            os.waitpid(-1, 0)
        except ChildProcessError:
            return


def children() -> list[int]:
    """Return the children of this process; none of their numbers can be used again before it waits for them."""
    if not has_children():
        return []
    found = []
    for entry in os.listdir("/proc"):  # noqa: PTH208 - pathlib is slow to import
        if not entry.isdigit():
            continue
        try:
            with open(f"/proc/{entry}/stat", "rb") as stat:  # noqa: PTH123 - as above
                parent = int(stat.read().rpartition(b")")[2].split()[1])
        except (FileNotFoundError, ProcessLookupError):
            continue  # it has ended since
        if parent == os.getpid():
            found.append(int(entry))
    return found


def has_children() -> bool:
    """Tell whether this process has children, in one question: most often there are none, and many other processes."""
    try:
        os.waitid(os.P_ALL, 0, os.WEXITED | os.WNOHANG | os.WNOWAIT)
    except ChildProcessError:
        return False
    return True


def kill(child: int) -> None:
    """Kill a child that has not been waited for."""
    try:
        os.kill(child, signal.SIGKILL)
    except PermissionError:
        return  # it has become another user's: all that can be done is to wait for it, and the caller has a limit


def set_subreaper(value: int) -> int:
    """Let this process inherit the orphans below it (1) or not (0); return what was so before."""
    import ctypes  # noqa: PLC0415 - slow, and not needed by all who import this

    before = ctypes.c_int()
    _prctl(_PR_GET_CHILD_SUBREAPER, ctypes.byref(before))
    _prctl(_PR_SET_CHILD_SUBREAPER, value)
    return before.value


def end_with_parent() -> None:
    """Let this process be killed when the one that has forked it ends, however that happens."""
    _prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)


def _prctl(option: int, value: object) -> None:
    import ctypes  # noqa: PLC0415 - as above

    if ctypes.CDLL(None, use_errno=True).prctl(option, value, 0, 0, 0) != 0:
        raise OSError(ctypes.get_errno(), f"prctl {option}")


if __name__ == "__main__":
    main()
