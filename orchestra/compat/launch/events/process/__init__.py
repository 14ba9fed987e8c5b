"""What launch files import as `launch.events.process`."""

from __future__ import annotations

from typing import Any

from orchestra.compat.lazy import exported

_NAMES = {
    "ProcessExited": "process_exited",
    "ProcessIO": "process_io",
    "ProcessStarted": "process_started",
    "ProcessStderr": "process_stderr",
    "ProcessStdin": "process_stdin",
    "ProcessStdout": "process_stdout",
    "ProcessTargetedEvent": "process_targeted_event",
    "RunningProcessEvent": "running_process_event",
    "ShutdownProcess": "shutdown_process",
    "SignalProcess": "signal_process",
    "matches_executable": "process_matchers",
    "matches_name": "process_matchers",
    "matches_pid": "process_matchers",
}

__all__ = sorted(_NAMES)  # noqa: PLE0605 - the names are those of the table

_attribute = exported(__name__, _NAMES)


def __getattr__(name: str) -> Any:
    return _attribute(name)
