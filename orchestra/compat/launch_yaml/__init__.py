"""What launch files import as `launch_yaml`."""

from __future__ import annotations

from typing import Any

from orchestra.compat.lazy import exported

_NAMES = {
    "Entity": "entity",
    "Parser": "parser",
    "entity": "",
    "launch_description_sources": "",
    "parser": "",
}

__all__ = ["Entity", "Parser"]

_attribute = exported(__name__, _NAMES)


def __getattr__(name: str) -> Any:
    return _attribute(name)
