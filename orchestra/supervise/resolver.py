"""The resolver process: `prepare` with everything heavy and all user code lives and dies there."""

from __future__ import annotations

import os
import signal
import sys

from orchestra.supervise import kernel
from orchestra.supervise.keeper import flush
from orchestra.supervise.signals import reset_signals

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import BinaryIO

BUG = 3


class Resolver:
    """A running resolver: its pid and the descriptor from which its document is read."""

    __slots__ = ("descriptor", "pid")

    def __init__(self, pid: int, descriptor: int) -> None:
        self.pid = pid
        self.descriptor = descriptor


def fork_resolver(prepare: Callable[[BinaryIO], int]) -> Resolver:
    """Run `prepare` in a child with default signals and a session of its own; it dies with its parent."""
    ours, theirs = os.pipe()
    parent = os.getpid()
    pid = os.fork()
    if pid:
        os.close(theirs)
        os.set_blocking(ours, False)
        return Resolver(pid, ours)
    status = BUG
    try:
        os.close(ours)
        kernel.die_with_parent(signal.SIGKILL, parent)
        kernel.set_name("orc-resolver")
        os.setsid()
        reset_signals()
        status = _prepare(prepare, theirs)
    finally:
        os._exit(status)


def _prepare(prepare: Callable[[BinaryIO], int], descriptor: int) -> int:
    try:
        with os.fdopen(descriptor, "wb") as stream:
            status = prepare(stream)
    except SystemExit as error:
        status = _status(error)
    except BaseException:  # noqa: BLE001 - the boundary of this process: nothing may run on into the supervisor's code
        sys.excepthook(*sys.exc_info())
        status = BUG
    flush()
    return status


def _status(error: SystemExit) -> int:
    """Do as the interpreter would at its end."""
    if error.code is None or isinstance(error.code, int):
        return error.code or 0
    sys.stderr.write(f"{error.code}\n")
    return 1
