"""A program that was started, whoever forked it: what is read of it, and how it ended."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import resource


class Child:
    """A started program: its pid, which is its process group and session too, a pidfd, and its output.

    `outputs` maps `stdout` and `stderr` to the descriptors to read; whoever reads them closes them. It is reaped by
    `reap` alone: until then the kernel gives neither the pid nor the group to anyone else, so signals to them can hit
    no stranger. `dumped` says whether the kernel wrote its memory to a core file, `usage` what it used, once it is
    reaped (getrusage(2)). With a `tty` the outputs are terminals, and what is written to the first is its input.
    """

    def __init__(self, pid: int, outputs: dict[str, int], *, tty: bool) -> None:
        self.pid = pid
        self.pidfd = os.pidfd_open(pid)
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
        _, _, self.usage = os.wait4(self.pid, 0)
        os.close(self.pidfd)
