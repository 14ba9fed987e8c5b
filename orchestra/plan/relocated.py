"""Texts rewritten wherever they stand in a value, as paths that are made symbolic."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from orchestra.fields import fields, is_dataclass, replace

if TYPE_CHECKING:
    from collections.abc import Callable

_T = TypeVar("_T")


def relocated(value: _T, folder: str, symbol: str) -> _T:
    """Return a value with a folder replaced by its symbol in every text; what has none stays the same."""
    return rewritten(value, lambda text: text.replace(folder, symbol) if folder in text else text)


def rewritten(value: _T, change: Callable[[str], str]) -> _T:
    """Return a value with every text in it changed; what has none that changes stays the same."""
    changed: _T = _rewritten(value, change)
    return changed


def _rewritten(value: Any, change: Callable[[str], str]) -> Any:  # noqa: ANN401 - any part of it
    if type(value) is str:  # words of an enumeration are none that anybody has written
        return change(value)
    if isinstance(value, tuple | list):
        items = [_rewritten(item, change) for item in value]
        return value if all(map(_same, items, value)) else type(value)(items)
    if isinstance(value, dict):
        changed = {_rewritten(key, change): _rewritten(item, change) for key, item in value.items()}
        same = all(map(_same, changed, value)) and all(map(_same, changed.values(), value.values()))
        return value if same else changed
    if is_dataclass(value) and type(value).__module__.startswith("orchestra."):
        record: Any = value
        values = {entry.name: getattr(record, entry.name) for entry in fields(record)}
        changed = {name: _rewritten(item, change) for name, item in values.items()}
        same = all(map(_same, changed.values(), values.values()))
        return value if same else replace(record, **changed)
    return value


def _same(one: object, other: object) -> bool:
    return one is other
