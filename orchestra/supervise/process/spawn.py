"""Starts a program in a session of its own, with pipes or terminals for its output.

There are two ways. The usual one is posix_spawn(3): the kernel lends the child our memory until its program begins
(CLONE_VFORK), so nothing of ours is copied and no code of ours runs in it; what the program inherits is set in us for
that moment. The other one is fork(2), for what only the child itself can do before its program begins: put limits in
force, take a terminal for its own. It takes several times as long, and grows with our memory.

The supervisor has given every signal its default action or a handler, and blocks none, so the program inherits neither
an ignored signal nor a mask (execve(2) resets handlers). Every other descriptor closes at the start (O_CLOEXEC).
"""

from __future__ import annotations

import errno
import fcntl
import os
import signal
import termios
from typing import TYPE_CHECKING

from orchestra.supervise.keeping import kernel
from orchestra.supervise.process import open_files, outputs
from orchestra.supervise.process.child import Child
from orchestra.supervise.process.inherited import inherited

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.supervise.process.outputs import Ends
    from orchestra.supervise.process.spec import Spec

# The interpreter ignores these, and a program is to begin with their default action.
_IGNORED_BY_US = (signal.SIGPIPE, signal.SIGXFSZ)


def spawn(spec: Spec, stdin: int | None = None) -> Child:
    """Start a program, with `stdin` as its standard input where one is given.

    Raises `OSError` where that is impossible; `filename` then names what is missing, or what asks for it.
    """
    with outputs.opened(spec) as ends:
        read = outputs.input_of(spec, ends) if stdin is None else stdin
        open_files.see_to_room(max(ends.outer.values()))
        try:
            pid = _spawned(spec, read, ends) or _forked(spec, read, ends)
        except (
            ValueError
        ) as error:  # from the interpreter, which hands on no such word; none can be (execve(2))
            raise OSError(errno.EINVAL, "a word of it has a byte that is 0") from error
        return watched(pid, ends.outer, tty=spec.tty or spec.foremost)


def watched(pid: int, outer: dict[str, int], *, tty: bool) -> Child:
    """Return a program that runs as one to watch; out of descriptors, it is ended: what nobody watches must not run.

    Raises `OSError`.
    """
    try:
        return Child(pid, outer, tty=tty)
    except OSError:
        os.killpg(pid, signal.SIGKILL)
        os.waitpid(pid, 0)
        raise


def _spawned(spec: Spec, read: int | None, ends: Ends) -> int | None:
    """Start it the usual way; None where that does not do. What fails here is tried the other way, which says why."""
    if spec.before_exec or spec.foremost:
        return None
    try:
        with inherited(spec):
            return os.posix_spawn(
                _program(spec.command[0], spec.environment.get("PATH", os.defpath)),
                spec.command,
                spec.environment,
                file_actions=[
                    (os.POSIX_SPAWN_OPEN, 0, os.devnull, os.O_RDWR, 0)
                    if read is None
                    else (os.POSIX_SPAWN_DUP2, read, 0),
                    (os.POSIX_SPAWN_DUP2, ends.inner[0], 1),
                    (os.POSIX_SPAWN_DUP2, ends.inner[1], 2),
                ],
                setsid=True,
                setsigdef=_IGNORED_BY_US,
            )
    except (OSError, NotImplementedError):  # the latter from a C library that knows no POSIX_SPAWN_SETSID
        return None


def _program(name: str, path: str) -> str:
    """Return the file that is executed: the first of the search path, which is the program's own."""
    if "/" in name:
        return name
    files = (f"{folder or '.'}/{name}" for folder in path.split(os.pathsep))
    return next((file for file in files if os.access(file, os.X_OK) and not os.path.isdir(file)), name)  # noqa: PTH112 - as it will be executed


def _forked(spec: Spec, read: int | None, ends: Ends) -> int:
    """Start it in a copy of ourselves that prepares itself. Raises `OSError`."""
    # Few programs are started so.
    import subprocess  # noqa: PLC0415

    from orchestra.supervise.process.preparing import reported  # noqa: PLC0415

    with reported(_before(spec)) as prepare:
        process = subprocess.Popen(  # noqa: S603 - running what the plan says is the purpose
            spec.command,
            env=spec.environment,
            cwd=spec.cwd,
            stdin=subprocess.DEVNULL if read is None else read,
            stdout=ends.inner[0],
            stderr=ends.inner[1],
            start_new_session=True,
            preexec_fn=prepare,  # noqa: PLW1509 - the other thread writes to files and holds no lock we could want
        )
    process.returncode = 0  # it is `Child` that waits for it
    return process.pid


def _before(spec: Spec) -> Callable[[], None]:
    """Return what is to be done in the child: it takes its terminal before anything may forbid it to.

    Before the program begins, our own handler would take a SIGTERM and be forgotten.
    """

    def before() -> None:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        open_files.give_back()
        if spec.mark is not None:
            kernel.set_lock_limit(spec.mark)
        if spec.foremost:
            fcntl.ioctl(0, termios.TIOCSCTTY, 0)
        if spec.before_exec:
            spec.before_exec()

    return before
