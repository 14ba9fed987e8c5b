"""What launch files import as `launch.event_handlers`."""

from __future__ import annotations

from typing import Any

from orchestra.compat.launch.event_handlers.event_named import event_named
from orchestra.compat.lazy import exported

_NAMES = {
    "OnActionEventBase": "on_action_event_base",
    "OnExecutionComplete": "on_execution_complete",
    "OnIncludeLaunchDescription": "on_include_launch_description",
    "OnProcessExit": "on_process_exit",
    "OnProcessIO": "on_process_io",
    "OnProcessStart": "on_process_start",
    "OnShutdown": "on_shutdown",
}

# A module of the same name is in its way: imported later, it would stand for the function.
__all__ = [*sorted(_NAMES), "event_named"]  # noqa: PLE0604 - the names are those of the table

_attribute = exported(__name__, _NAMES)


def __getattr__(name: str) -> Any:
    return _attribute(name)
