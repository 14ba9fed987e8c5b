"""Attributes as the types that are asked for.

Upstream coerces the texts of XML, but in YAML insists on the native type of each value, so that `respawn_delay: 2` and
`value: 1` are refused. Here what is written plainly means the same in both.
"""

from __future__ import annotations

from typing import Any, get_args, get_origin

from orchestra.compat.launch.utilities.type_utils import get_typed_value, is_instance_of
from orchestra.description.source import Written


def typed(raw: Any, data_type: Any, *, can_be_str: bool) -> Any:
    """Return a value as a type, None: as YAML reads it. Raises `ValueError` or `TypeError` where it is none."""
    if isinstance(raw, Written):
        return _scalar(raw, data_type, can_be_str=can_be_str)
    if isinstance(raw, str):
        return raw if data_type is str else get_typed_value(raw, data_type, can_be_str=can_be_str)
    if isinstance(raw, list) and any(isinstance(item, Written) for item in raw):
        return _items(raw, data_type, can_be_str=can_be_str)
    return _native(raw, data_type, can_be_str=can_be_str)


def _scalar(written: Written, data_type: Any, *, can_be_str: bool) -> Any:
    if written.null:
        raise TypeError("nothing is written there")
    if data_type is str or (data_type is None and written.quoted):
        return written.text
    return get_typed_value(written.text, data_type, can_be_str=can_be_str)


def _items(items: list[Any], data_type: Any, *, can_be_str: bool) -> list[Any]:
    if data_type is not None and get_origin(data_type) is not list:
        raise TypeError("a list is written there")
    kind = get_args(data_type)[0] if data_type is not None else None
    values = [typed(item, kind, can_be_str=can_be_str) for item in items]
    return _native(values, data_type, can_be_str=can_be_str)  # type: ignore[no-any-return]  # a list stays one


def _native(value: Any, data_type: Any, *, can_be_str: bool) -> Any:
    if data_type is float and isinstance(value, int) and not isinstance(value, bool):
        return float(value)
    if data_type is str and isinstance(value, bool | int | float):
        return str(value)
    if not is_instance_of(value, data_type, can_be_str=can_be_str):
        raise TypeError(f"{value!r} has another type")
    return value
