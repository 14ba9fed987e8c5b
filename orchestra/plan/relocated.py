"""What was resolved, with paths below one folder made symbolic."""

from __future__ import annotations

import dataclasses
from typing import Any, TypeVar

_T = TypeVar("_T")


def relocated(value: _T, folder: str, symbol: str) -> _T:
    """Return a value with a folder replaced by its symbol in every text; what has none stays the same."""
    changed: _T = _relocated(value, folder, symbol)
    return changed


def _relocated(value: Any, folder: str, symbol: str) -> Any:  # noqa: ANN401 - any part of it
    if isinstance(value, str):
        return value.replace(folder, symbol) if folder in value else value
    if isinstance(value, tuple | list):
        items = [_relocated(item, folder, symbol) for item in value]
        return value if all(map(_same, items, value)) else type(value)(items)
    if isinstance(value, dict):
        changed = {
            _relocated(key, folder, symbol): _relocated(item, folder, symbol) for key, item in value.items()
        }
        return value if all(map(_same, changed.values(), value.values())) else changed
    if dataclasses.is_dataclass(value) and type(value).__module__.startswith("orchestra."):
        record: Any = value
        fields = {entry.name: getattr(record, entry.name) for entry in dataclasses.fields(record)}
        changed = {name: _relocated(item, folder, symbol) for name, item in fields.items()}
        same = all(map(_same, changed.values(), fields.values()))
        return value if same else dataclasses.replace(record, **changed)
    return value


def _same(one: object, other: object) -> bool:
    return one is other
