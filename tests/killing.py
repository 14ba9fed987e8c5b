"""Ends nodes of tests by SIGKILL."""

from __future__ import annotations

import atexit
from typing import TYPE_CHECKING

from orchestra.supervise.keeping.shared_memory import DeadReaders

if TYPE_CHECKING:
    import subprocess

_DEAD = DeadReaders()
atexit.register(_DEAD.end)


def kill(process: subprocess.Popen[str] | subprocess.Popen[bytes]) -> None:
    """Kill a process, and let nobody who sends to it hang for it, as the supervisor does for its own."""
    process.kill()
    process.wait()
    let_nobody_hang()


def let_nobody_hang() -> None:
    """Close the ports of those that have just been killed."""
    _DEAD.close()
