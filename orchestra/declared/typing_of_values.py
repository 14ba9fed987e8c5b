"""The types of ROS: what a value is, whether a declaration takes it, and how it should have been written."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.declared.texts import written
from orchestra.nearest import nearest
from orchestra.resolve.rcl.commas import without_slip

if TYPE_CHECKING:
    from orchestra.declared.model import Parameter, RosType
    from orchestra.values import ParameterValue

_SCALARS: Final[dict[type, RosType]] = {bool: "bool", int: "integer", float: "double", str: "string"}
_LISTS: Final[dict[type, RosType]] = {
    bool: "bool_array",
    int: "integer_array",
    float: "double_array",
    str: "string_array",
}
# What texts in quotes say that are meant as truth values.
_TRUTHS: Final = {
    **dict.fromkeys(("1", "on", "true", "y", "yes"), "true"),
    **dict.fromkeys(("0", "false", "n", "no", "off"), "false"),
}
_AS_PYTHON: Final = ("True", "False")


def type_of(value: ParameterValue) -> RosType | None:
    """Return the type that rcl gives a value, None for an empty list, which has none."""
    if isinstance(value, tuple):
        return _LISTS[type(value[0])] if value else None
    return _SCALARS[type(value)]


def is_taken(parameter: Parameter, value: ParameterValue) -> bool | None:
    """Return whether a parameter takes a value of its type, None where the schema alone would."""
    kind = type_of(value)
    if not parameter.types or kind in parameter.types:
        return True
    if kind is None:
        return any(item.endswith("_array") for item in parameter.types)
    if kind not in parameter.tolerated:
        return False
    if kind.startswith("double"):  # whole numbers that are written as doubles
        items = value if isinstance(value, tuple) else (value,)
        return None if all(isinstance(item, float) and item.is_integer() for item in items) else False
    return None


def rewritten(value: ParameterValue, types: tuple[RosType, ...]) -> str | None:
    """Return how a value is written as one of these types, None where it cannot be meant as one."""
    for kind in types:
        element = kind.removesuffix("_array")
        if element == kind:
            text = None if isinstance(value, tuple) else _scalar(value, kind)
        else:
            items = value if isinstance(value, tuple) else (value,)
            texts = [_scalar(item, element) for item in items]
            sound = [item for item in texts if item is not None]
            text = f"[{', '.join(sound)}]" if len(sound) == len(texts) else None
        if text is not None:
            return text
    return None


def _scalar(value: ParameterValue, kind: str) -> str | None:
    if isinstance(value, tuple):
        return None
    if kind == "string":
        return written(value) if isinstance(value, str) else f'"{written(value)}"'
    if isinstance(value, str):
        meant = without_slip(value.strip())
        text = value.strip() if meant is None else meant[1].partition(" #")[0]
        slip = kind == "bool" and text in _AS_PYTHON and text != value.strip()
        return text if slip else _unquoted(text, kind)
    if isinstance(value, bool):
        return written(value) if kind == "bool" else None
    if kind == "bool":
        return written(bool(value)) if value in (0, 1) else None
    if kind == "double":
        return written(float(value))
    if kind == "integer" and float(value).is_integer():
        return str(int(value))
    return None


def _unquoted(text: str, kind: str) -> str | None:
    """Return a text in quotes as what it says."""
    if kind == "bool":
        near = nearest(text, ("true", "false"))
        return _TRUTHS.get(text.lower()) or (
            near.capitalize() if near is not None and text.istitle() else near
        )
    try:
        return str(int(text)) if kind == "integer" else written(float(text)) if kind == "double" else None
    except ValueError:
        return _computed(text) if kind == "double" else None


def _computed(text: str) -> str | None:
    from orchestra.resolve.rcl.computed import computed  # noqa: PLC0415 - few texts are to be computed

    return computed(text)
