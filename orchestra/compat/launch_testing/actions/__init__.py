"""What launch files import as `launch_testing.actions`."""

from __future__ import annotations

from typing import Any

from orchestra.compat.lazy import exported

_NAMES = {
    "GTest": "gtest",
    "PyTest": "pytest",
    "ReadyToTest": "ready",
    "Test": "test",
}

__all__ = sorted(_NAMES)  # noqa: PLE0605 - the names are those of the table

_attribute = exported(__name__, _NAMES)


def __getattr__(name: str) -> Any:
    return _attribute(name)
