"""Ends nodes of tests by SIGKILL."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.supervise.keeping.shared_memory import release_dead_readers

if TYPE_CHECKING:
    import subprocess


def kill(process: subprocess.Popen[str] | subprocess.Popen[bytes]) -> None:
    """Kill a process, and let nobody who sends to it hang for it, as the supervisor does for its own."""
    process.kill()
    process.wait()
    release_dead_readers()
