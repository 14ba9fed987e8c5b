"""What launch files import as `launch_xml`."""

from __future__ import annotations

from typing import Any

from orchestra.compat.lazy import exported

__all__ = ["Entity", "Parser"]

_attribute = exported(__name__, {"Entity": "entity", "Parser": "parser"})


def __getattr__(name: str) -> Any:
    return _attribute(name)
