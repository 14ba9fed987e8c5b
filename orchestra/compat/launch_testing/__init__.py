"""What tests of launches import as `launch_testing`: what describes and marks them; nothing runs them here."""

from __future__ import annotations

from typing import Any

from orchestra.compat.lazy import exported

_NAMES = {
    "ActiveIoHandler": "running",
    "ActiveProcInfoHandler": "running",
    "IoHandler": "running",
    "ProcInfoHandler": "running",
    "ReadyAggregator": "running",
    "actions": "",
    "asserts": "",
    "event_handlers": "",
    "legacy": "",
    "markers": "",
    "parametrize": "parametrization",
    "post_shutdown_test": "post_shutdown",
    "ready_to_test_action_timeout": "ready_timeout",
    "tools": "",
    "util": "",
}

__all__ = sorted(_NAMES)  # noqa: PLE0605 - the names are those of the table

_attribute = exported(__name__, _NAMES)


def __getattr__(name: str) -> Any:
    return _attribute(name)
