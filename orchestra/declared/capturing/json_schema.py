"""Captured parameters as a JSON Schema of the 2020-12 draft."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Final

from orchestra.declared.plain_schema import ROS_STEP, ROS_TYPE

if TYPE_CHECKING:
    from orchestra.declared.capturing.model import Captured, CapturedParameter

CONSTRAINTS: Final = "x-ros-additional-constraints"
_DRAFT: Final = "https://json-schema.org/draft/2020-12/schema"
_TYPES: Final = {"bool": "boolean", "integer": "integer", "double": "number", "string": "string"}
_BYTE: Final = {"type": "integer", "minimum": 0, "maximum": 255}


def as_json_schema(captured: Captured) -> dict[str, Any]:
    """Return the schema; values in force are the defaults.

    A dot in a name is a level, but where a name is both that of a parameter and of a group.
    """
    root = _level(f"Parameters of {captured.node}")
    names = {parameter.name for parameter in captured.parameters}
    for parameter in captured.parameters:
        *groups, last = _path(parameter.name, names)
        level = root
        for group in groups:
            level = level["properties"].setdefault(group, _level())
        level["properties"][last] = _property(parameter)
    return {"$schema": _DRAFT, **root}


def _level(title: str | None = None) -> dict[str, Any]:
    named = {} if title is None else {"title": title}
    return {**named, "type": "object", "additionalProperties": False, "properties": {}}


def _path(name: str, names: set[str]) -> list[str]:
    parts = name.split(".")
    above = [".".join(parts[:end]) for end in range(1, len(parts))]
    return [name] if any(item in names for item in above) else parts


def _property(parameter: CapturedParameter) -> dict[str, Any]:
    found: dict[str, Any] = {} if parameter.dynamic_typing else _type(parameter.type)
    found |= {"description": parameter.description} if parameter.description else {}
    found |= _range(parameter)
    found |= {"readOnly": True} if parameter.read_only else {}
    found |= {CONSTRAINTS: parameter.additional_constraints} if parameter.additional_constraints else {}
    if parameter.value is not None and _is_json(parameter.value):
        found["default"] = parameter.value
    return found


def _type(kind: str | None) -> dict[str, Any]:
    if kind is None:
        return {}
    element, _, array = kind.partition("_")
    if not array:
        return {"type": _TYPES[element], ROS_TYPE: kind}
    items = _BYTE if element == "byte" else {"type": _TYPES[element]}
    return {"type": "array", "items": dict(items), ROS_TYPE: kind}


def _range(parameter: CapturedParameter) -> dict[str, Any]:
    if parameter.range is None:
        return {}
    low, high, step = parameter.range
    integers = parameter.type == "integer"
    found: dict[str, Any] = {"minimum": low} if _is_json(low) else {}
    found |= {"maximum": high} if _is_json(high) else {}
    if not step or (integers and step == 1):
        return found
    found[ROS_STEP] = step
    if integers and low % step == 0 and high % step == 0:
        found["multipleOf"] = step  # the same, for those who do not know ROS
    return found


def _is_json(value: Any) -> bool:  # noqa: ANN401 - of any of ROS's types
    """Return whether JSON has such a value: it has neither NaN nor infinity."""
    items = value if isinstance(value, list) else [value]
    return all(not isinstance(item, float) or math.isfinite(item) for item in items)
