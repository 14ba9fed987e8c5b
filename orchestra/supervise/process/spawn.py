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
from contextlib import ExitStack
from typing import TYPE_CHECKING

from orchestra.supervise.keeping import kernel
from orchestra.supervise.output.terminal import our_size, set_size
from orchestra.supervise.process import open_files
from orchestra.supervise.process.preparing import reported

if TYPE_CHECKING:
    import resource
    from collections.abc import Callable

    from orchestra.supervise.process.spec import Spec

_OUTPUT_FLAGS = 1  # the index of c_oflag in what tcgetattr returns


class Child:
    """A started program: its pid, which is its process group and session too, a pidfd, and its output.

    `outputs` maps `stdout` and `stderr` to the descriptors to read; whoever reads them closes them. It is reaped by
    `reap` alone: until then the kernel gives neither the pid nor the group to anyone else, so signals to them can hit
    no stranger. `dumped` says whether the kernel wrote its memory to a core file, `usage` what it used, once it is
    reaped (getrusage(2)). With a `tty` the outputs are terminals, and what is written to the first is its input.
    """

    def __init__(self, process: subprocess.Popen[bytes], outputs: dict[str, int], *, tty: bool) -> None:
        self._process = process
        self.pid = process.pid
        self.pidfd = os.pidfd_open(process.pid)
        self.outputs = outputs
        self.tty = tty
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
    if any(
        "\0" in word
        for word in (*spec.command, *spec.environment, *spec.environment.values(), spec.cwd or "")
    ):
        raise OSError(errno.EINVAL, "a word of it has a byte that is 0")  # none can (execve(2))
    with ExitStack() as ours, ExitStack() as theirs, reported(_before(spec)) as prepare:
        outputs, inner = _outputs(spec, ours, theirs)
        process = subprocess.Popen(  # noqa: S603 - running what the plan says is the purpose
            spec.command,
            env=spec.environment,
            cwd=spec.cwd,
            stdin=_stdin(spec, inner) if stdin is None else stdin,
            stdout=inner[0],
            stderr=inner[1],
            start_new_session=True,
            preexec_fn=prepare,  # noqa: PLW1509 - the other thread writes to files and holds no lock we could want
        )
        child = _child(process, outputs, tty=spec.tty or spec.foremost)
        ours.pop_all()
    return child


def _child(process: subprocess.Popen[bytes], outputs: tuple[int, ...], *, tty: bool) -> Child:
    try:
        for descriptor in outputs:
            os.set_blocking(descriptor, False)
        return Child(process, dict(zip(("stdout", "stderr"), outputs, strict=False)), tty=tty)
    except OSError:  # out of descriptors: what cannot be watched must not run
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
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


def _stdin(spec: Spec, inner: tuple[int, int]) -> int | None:
    if spec.foremost:
        return inner[0]
    if spec.stdin:
        return None
    return inner[0] if spec.tty else subprocess.DEVNULL


def _outputs(spec: Spec, ours: ExitStack, theirs: ExitStack) -> tuple[tuple[int, ...], tuple[int, int]]:
    """Return what we read, and what the program writes to as its output and its errors."""
    if spec.foremost:
        outer, inner = _terminal(ours, theirs)
        return (outer,), (inner, inner)
    return _terminals(ours, theirs) if spec.tty else _pipes(ours, theirs)


def _pipes(ours: ExitStack, theirs: ExitStack) -> tuple[tuple[int, int], tuple[int, int]]:
    (out, inner_out), (err, inner_err) = (_owned(os.pipe(), ours, theirs) for _ in range(2))
    return (out, err), (inner_out, inner_err)


def _terminals(ours: ExitStack, theirs: ExitStack) -> tuple[tuple[int, int], tuple[int, int]]:
    (out, inner_out), (err, inner_err) = (_terminal(ours, theirs) for _ in range(2))
    return (out, err), (inner_out, inner_err)


def _terminal(ours: ExitStack, theirs: ExitStack) -> tuple[int, int]:
    outer, inner = _owned(os.openpty(), ours, theirs)
    _make_plain(inner)
    return outer, inner


def _owned(pair: tuple[int, int], ours: ExitStack, theirs: ExitStack) -> tuple[int, int]:
    ours.callback(os.close, pair[0])
    theirs.callback(os.close, pair[1])
    return pair


def _make_plain(terminal: int) -> None:
    """Let bytes pass as they are (no newline becomes two characters), and give the size of our own terminal."""
    modes = termios.tcgetattr(terminal)
    modes[_OUTPUT_FLAGS] &= ~termios.OPOST
    termios.tcsetattr(terminal, termios.TCSANOW, modes)
    set_size(terminal, *our_size())
