"""Assertions about what processes did."""

from __future__ import annotations

from orchestra.compat.launch_testing.running import belongs_to_running
from orchestra.compat.launch_testing.util.proc_lookup import NO_CMD_ARGS

__all__ = [
    "EXIT_OK",
    "EXIT_SIGINT",
    "EXIT_SIGKILL",
    "EXIT_SIGQUIT",
    "EXIT_SIGSEGV",
    "NO_CMD_ARGS",
    "SequentialTextChecker",
    "assertDefaultStream",
    "assertExitCodes",
    "assertInStderr",
    "assertInStdout",
    "assertInStream",
    "assertSequentialStdout",
]

EXIT_OK = 0
EXIT_SIGINT = 130
EXIT_SIGQUIT = 131
EXIT_SIGKILL = 137
EXIT_SIGSEGV = 139

# ruff: noqa: N816
SequentialTextChecker = belongs_to_running("SequentialTextChecker")
assertExitCodes = belongs_to_running("assertExitCodes")
assertInStderr = belongs_to_running("assertInStderr")
assertInStdout = belongs_to_running("assertInStdout")
assertInStream = belongs_to_running("assertInStream")
assertSequentialStdout = belongs_to_running("assertSequentialStdout")


def assertDefaultStream() -> str:  # noqa: N802 - upstream's name
    """Return the stream that assertions look at."""
    return "stderr"
