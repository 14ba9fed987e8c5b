"""Values of parameters: from YAML to one of the nine types, and back to plain data and text."""

from __future__ import annotations

from typing import Any, Final

from rcl_interfaces.msg import ParameterType, ParameterValue

from orchestra.errors import RunError

# Each type: its name, the words before a value, the field of the message.
_KINDS: Final = {
    ParameterType.PARAMETER_BOOL: ("boolean", "Boolean value is:", "bool_value"),
    ParameterType.PARAMETER_INTEGER: ("integer", "Integer value is:", "integer_value"),
    ParameterType.PARAMETER_DOUBLE: ("double", "Double value is:", "double_value"),
    ParameterType.PARAMETER_STRING: ("string", "String value is:", "string_value"),
    ParameterType.PARAMETER_BYTE_ARRAY: ("byte array", "Byte values are:", "byte_array_value"),
    ParameterType.PARAMETER_BOOL_ARRAY: ("boolean array", "Boolean values are:", "bool_array_value"),
    ParameterType.PARAMETER_INTEGER_ARRAY: ("integer array", "Integer values are:", "integer_array_value"),
    ParameterType.PARAMETER_DOUBLE_ARRAY: ("double array", "Double values are:", "double_array_value"),
    ParameterType.PARAMETER_STRING_ARRAY: ("string array", "String values are:", "string_array_value"),
}
_ARRAYS: Final = tuple(kind for kind, (name, *_) in _KINDS.items() if name.endswith("array"))
_UNSET: Final = ("not set", "Parameter not set.", "")
_INTEGERS: Final = (-(2**63), 2**63 - 1)


def type_name(kind: int) -> str:
    """Return the name of a type."""
    return _KINDS.get(kind, _UNSET)[0]


def label(value: Any) -> str:  # noqa: ANN401 - of an untyped package
    """Return the words before a value."""
    return _KINDS.get(value.type, _UNSET)[1]


def held(value: Any) -> Any:  # noqa: ANN401 - as above
    """Return the value that a message holds, None where it holds none."""
    field = _KINDS.get(value.type, _UNSET)[2]
    return getattr(value, field) if field else None


def plain_value(value: Any) -> Any:  # noqa: ANN401 - as above
    """Return it as plain data: a list for several, bytes as they are."""
    found = held(value)
    return found if found is None or isinstance(found, bool | int | float | str) else list(found)


def is_empty(value: Any) -> bool:  # noqa: ANN401 - as above
    """Tell whether it is an array in which nothing is."""
    return value.type in _ARRAYS and not len(held(value))


def retyped(value: Any, like: Any) -> ParameterValue:  # noqa: ANN401 - as above
    """Return an empty array as one of the type that another value has, where that is an array."""
    return ParameterValue(type=like.type) if like.type in _ARRAYS else value


def json_value(value: Any) -> Any:  # noqa: ANN401 - as above
    """Return it as JSON data: bytes are numbers."""
    found = plain_value(value)
    return (
        [item[0] if isinstance(item, bytes) else item for item in found] if isinstance(found, list) else found
    )


def value_of_text(text: str) -> ParameterValue:
    """Return the value that a text stands for, by the rules of YAML: `'!!str 1'` is a string. Raises `RunError`.

    What YAML reads as nothing (`null`), or not at all, is meant as it stands, as in the ROS 2 tools.
    """
    import yaml  # noqa: PLC0415 - only where somebody gives a text

    try:
        found = yaml.safe_load(text)
    except yaml.YAMLError:
        found = None
    return value_of(text if found is None else found)


def value_of(data: Any) -> ParameterValue:  # noqa: ANN401 - whatever YAML gives
    """Return the value of plain data. Raises `RunError` for what no parameter can have."""
    if isinstance(data, bool):
        return _made(ParameterType.PARAMETER_BOOL, data)
    if isinstance(data, int):
        return _made(ParameterType.PARAMETER_INTEGER, _bounded(data))
    if isinstance(data, float):
        return _made(ParameterType.PARAMETER_DOUBLE, data)
    if isinstance(data, bytes):
        return _made(ParameterType.PARAMETER_BYTE_ARRAY, [bytes([byte]) for byte in data])
    if isinstance(data, list):
        return _array(data)
    if data is None:
        return ParameterValue()
    if isinstance(data, dict):
        raise RunError("a parameter has no mapping as its value")
    return _made(ParameterType.PARAMETER_STRING, str(data))


def _array(items: list[Any]) -> ParameterValue:
    """Return the value of a list. Nothing tells the type of an empty one: it is of booleans, as in the ROS 2 tools."""
    kinds = {type(item) for item in items}
    if kinds <= {bool}:
        return _made(ParameterType.PARAMETER_BOOL_ARRAY, items)
    if kinds == {int}:
        return _made(ParameterType.PARAMETER_INTEGER_ARRAY, [_bounded(item) for item in items])
    if kinds and kinds <= {int, float}:
        return _made(ParameterType.PARAMETER_DOUBLE_ARRAY, [float(item) for item in items])
    if kinds == {bytes}:
        return _made(ParameterType.PARAMETER_BYTE_ARRAY, [bytes([byte]) for item in items for byte in item])
    if kinds & {list, dict}:
        raise RunError("a parameter has no lists or mappings in a list")
    if kinds <= {str}:
        return _made(ParameterType.PARAMETER_STRING_ARRAY, items)
    raise RunError(f"all items of a list are of one type: {items!r} has {len(kinds)}")


def _bounded(number: int) -> int:
    least, most = _INTEGERS
    if not least <= number <= most:
        raise RunError(f"an integer is from {least} to {most}: {number} is not")
    return number


def _made(kind: int, data: Any) -> ParameterValue:  # noqa: ANN401 - as above
    return ParameterValue(type=kind, **{_KINDS[kind][2]: data})
