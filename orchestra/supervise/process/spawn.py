"""Starts a program in a session of its own, with pipes or terminals for its output.

The supervisor has given every signal its default action or a handler, and blocks none, so the program inherits neither
an ignored signal nor a mask (execve(2) resets handlers). Every other descriptor closes at the start (O_CLOEXEC).
"""

from __future__ import annotations

import errno
import fcntl
import os
import signal
import subprocess
import termios
from typing import TYPE_CHECKING

from orchestra.supervise.keeping import kernel
from orchestra.supervise.process import open_files, outputs
from orchestra.supervise.process.child import Child
from orchestra.supervise.process.preparing import reported

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.supervise.process.spec import Spec


def spawn(spec: Spec, stdin: int | None = None) -> Child:
    """Start a program, with `stdin` as its standard input where one is given.

    Raises `OSError` where that is impossible; `filename` then names what is missing, or what asks for it.
    """
    if any(
        "\0" in word
        for word in (*spec.command, *spec.environment, *spec.environment.values(), spec.cwd or "")
    ):
        raise OSError(errno.EINVAL, "a word of it has a byte that is 0")  # none can (execve(2))
    with outputs.opened(spec) as ends, reported(_before(spec)) as prepare:
        read = outputs.input_of(spec, ends) if stdin is None else stdin
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
        return watched(process.pid, ends.outer, tty=spec.tty or spec.foremost)


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


def _before(spec: Spec) -> Callable[[], None]:
    """Return what is to be done in the child: it takes its terminal before anything may forbid it to.

    It gets SIGTERM when the supervisor is killed, since the keeper, who would end it, may be killed as well. Before the
    program begins, our own handler would take that signal and be forgotten.
    """
    supervisor = os.getpid()

    def before() -> None:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        kernel.die_with_parent(signal.SIGTERM, supervisor)
        open_files.give_back()
        if spec.foremost:
            fcntl.ioctl(0, termios.TIOCSCTTY, 0)
        if spec.before_exec:
            spec.before_exec()

    return before
