"""Starts a program in a session of its own, with pipes or terminals for its output.

The supervisor has given every signal its default action or a handler, and blocks none, so the program inherits neither
an ignored signal nor a mask (execve(2) resets handlers). Every other descriptor closes at the start (O_CLOEXEC).
"""

from __future__ import annotations

import fcntl
import os
import signal
import subprocess
import termios
from contextlib import ExitStack
from typing import TYPE_CHECKING

from orchestra.supervise.preparing import reported

if TYPE_CHECKING:
    import resource

    from orchestra.supervise.spec import Spec

_OUTPUT_FLAGS = 1  # the index of c_oflag in what tcgetattr returns


class Child:
    """A started program: its pid, which is its process group and session too, a pidfd, and its output.

    `outputs` maps `stdout` and `stderr` to the descriptors to read; whoever reads them closes them. It is reaped by
    `reap` alone: until then the kernel gives neither the pid nor the group to anyone else, so signals to them can hit
    no stranger. `dumped` says whether the kernel wrote its memory to a core file, `usage` what it used, once it is
    reaped (getrusage(2)).
    """

    def __init__(self, process: subprocess.Popen[bytes], outputs: dict[str, int]) -> None:
        self._process = process
        self.pid = process.pid
        self.pidfd = os.pidfd_open(process.pid)
        self.outputs = outputs
        self.dumped = False
        self.usage: resource.struct_rusage | None = None

    def ended(self) -> tuple[int | None, int | None] | None:
        """Return exit code and signal, of which one is None; None while it runs. It stays unreaped."""
        result = os.waitid(os.P_PID, self.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT)
        if result is None:
            return None
        exited = result.si_code == os.CLD_EXITED
        self.dumped = result.si_code == os.CLD_DUMPED
        return (result.si_status, None) if exited else (None, result.si_status)

    def reap(self) -> None:
        """Collect the ended program."""
        _, status, self.usage = os.wait4(self.pid, 0)
        self._process.returncode = os.waitstatus_to_exitcode(status)
        os.close(self.pidfd)


def spawn(spec: Spec, stdin: int | None = None) -> Child:
    """Start a program, with `stdin` as its standard input where one is given.

    Raises `OSError` where that is impossible; `filename` then names what is missing, or what asks for it.
    """
    with ExitStack() as ours, ExitStack() as theirs, reported(spec.before_exec) as prepare:
        outputs, inner = _terminals(ours, theirs) if spec.tty else _pipes(ours, theirs)
        process = subprocess.Popen(  # noqa: S603 - running what the plan says is the purpose
            spec.command,
            env=spec.environment,
            cwd=spec.cwd,
            stdin=_stdin(spec, inner) if stdin is None else stdin,
            stdout=inner[0],
            stderr=inner[1],
            start_new_session=True,
            preexec_fn=prepare,  # noqa: PLW1509 - the supervisor has one thread
        )
        child = _child(process, outputs)
        ours.pop_all()
    return child


def _child(process: subprocess.Popen[bytes], outputs: tuple[int, int]) -> Child:
    try:
        for descriptor in outputs:
            os.set_blocking(descriptor, False)
        return Child(process, dict(zip(("stdout", "stderr"), outputs, strict=True)))
    except OSError:  # out of descriptors: what cannot be watched must not run
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        raise


def _stdin(spec: Spec, inner: tuple[int, int]) -> int | None:
    if spec.stdin:
        return None
    return inner[0] if spec.tty else subprocess.DEVNULL


def _pipes(ours: ExitStack, theirs: ExitStack) -> tuple[tuple[int, int], tuple[int, int]]:
    (out, inner_out), (err, inner_err) = (_owned(os.pipe(), ours, theirs) for _ in range(2))
    return (out, err), (inner_out, inner_err)


def _terminals(ours: ExitStack, theirs: ExitStack) -> tuple[tuple[int, int], tuple[int, int]]:
    (out, inner_out), (err, inner_err) = (_owned(os.openpty(), ours, theirs) for _ in range(2))
    for descriptor in (inner_out, inner_err):
        _make_plain(descriptor)
    return (out, err), (inner_out, inner_err)


def _owned(pair: tuple[int, int], ours: ExitStack, theirs: ExitStack) -> tuple[int, int]:
    ours.callback(os.close, pair[0])
    theirs.callback(os.close, pair[1])
    return pair


def _make_plain(terminal: int) -> None:
    """Let bytes pass as they are (no newline becomes two characters), and give the size of our own terminal."""
    modes = termios.tcgetattr(terminal)
    modes[_OUTPUT_FLAGS] &= ~termios.OPOST
    termios.tcsetattr(terminal, termios.TCSANOW, modes)
    columns, lines = _size()
    fcntl.ioctl(
        terminal, termios.TIOCSWINSZ, b"".join(n.to_bytes(2, "little") for n in (lines, columns, 0, 0))
    )


def _size() -> tuple[int, int]:
    try:
        columns, lines = os.get_terminal_size(1)
    except OSError:
        columns, lines = 0, 0
    return (columns or 80, lines or 24)
