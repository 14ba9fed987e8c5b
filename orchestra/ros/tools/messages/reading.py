"""From YAML that a user has written to the fields of a message.

What it accepts is what `set_message_fields` of rosidl_runtime_py accepts; beyond that, numbers are held against the
bounds of their type, which the generated classes do not do of themselves.
"""

from __future__ import annotations

from array import array
from typing import Any, Final

from rosidl_parser.definition import Array, BasicType, NamespacedType

from orchestra.errors import RunError
from orchestra.nearest import nearest
from orchestra.ros.tools.messages.fields import Kind, fields_of, is_basic, is_nested, is_text, name_of

_BITS: Final = {
    **{f"int{bits}": (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) for bits in (8, 16, 32, 64)},
    **{f"uint{bits}": (0, 2**bits - 1) for bits in (8, 16, 32, 64)},
}
_HEADER: Final = "std_msgs/msg/Header"
_TIME: Final = "builtin_interfaces/msg/Time"
_TRUTH: Final = {"true": True, "false": False}
# What YAML 1.1 takes for a truth value is a name of a field as well (robot_localization's ToggleFilterProcessing).
_NAMES: Final = {True: ("on", "yes", "true"), False: ("off", "no", "false")}


def mapping_of(text: str) -> dict[str, Any]:
    """Return the mapping that a text stands for, an empty one for an empty text. Raises `RunError`."""
    import yaml  # noqa: PLC0415 - only where somebody gives a text

    try:
        found = yaml.safe_load(text)
    except yaml.YAMLError as error:
        problem = getattr(error, "problem", None) or "it cannot be read"
        mark = getattr(error, "problem_mark", None)
        where = "" if mark is None else f" at line {mark.line + 1}, column {mark.column + 1}"
        raise RunError(f"the values are no YAML: {problem}{where}") from None
    if found is None or found == "":
        return {}
    if not isinstance(found, dict):
        raise RunError("The passed value needs to be a dictionary in YAML format, as '{data: 1}'")
    return found


def fill_from(text: str, message: Any) -> list[tuple[Any, str, Any]]:  # noqa: ANN401 - of any class
    """Set the fields of a message that a text in YAML names, as `fill` does it. Raises `RunError`."""
    values = mapping_of(text)
    try:
        return fill(message, values)
    except RunError as error:
        raise RunError(f"Failed to populate field: {error}") from None


def fill(message: Any, values: Any, path: str = "") -> list[tuple[Any, str, Any]]:  # noqa: ANN401 - of any class
    """Set fields of a message. Raises `RunError` for what cannot be their value.

    Returns what is to have the current time: messages, the names of fields, and the class of time that they have.
    """
    if not isinstance(values, dict):
        raise RunError(f"{path or 'the message'} has fields: a mapping is expected, not {_shown(values)}")
    kinds = dict(fields_of(type(message)))
    timed: list[tuple[Any, str, Any]] = []
    for key, value in values.items():
        name = next((word for word in _NAMES[key] if word in kinds), key) if isinstance(key, bool) else key
        where = f"{path}.{name}" if path else str(name)
        if name not in kinds:
            raise RunError(f"{type(message).__name__} has no field {where}{_hint(str(name), kinds)}")
        kind = kinds[name]
        current = getattr(message, name)
        if isinstance(kind, NamespacedType):
            if value == "auto" and name_of(kind) == _HEADER:
                timed.append((current, "stamp", type(current.stamp)))
            elif value == "now" and name_of(kind) == _TIME:
                timed.append((message, name, type(current)))
            else:
                timed += fill(current, value, where)
        else:
            setattr(message, name, _value(kind, value, current, where, timed))
    return timed


def _value(kind: Kind, value: Any, current: Any, where: str, timed: list[Any]) -> Any:  # noqa: ANN401 - as above
    if is_nested(kind):
        return _items(kind, value, current, where, timed)
    if isinstance(kind, NamespacedType):
        made = _class_of(kind)()
        timed += fill(made, value, where)
        return made
    if is_text(kind):
        return _text(kind, value, where)
    return _basic(kind, value, where)


def _items(kind: Kind, value: Any, current: Any, where: str, timed: list[Any]) -> Any:  # noqa: ANN401 - as above
    item = kind.value_type
    if isinstance(value, bytes | str) and isinstance(item, BasicType) and item.typename in ("uint8", "octet"):
        value = value.encode() if isinstance(value, str) else value
        value = list(value) if item.typename == "uint8" else [bytes([one]) for one in value]
    if not isinstance(value, list | tuple):
        raise RunError(f"{where} has several values: a list is expected, not {_shown(value)}")
    if isinstance(kind, Array) and len(value) != kind.size:
        raise RunError(f"{where} has {kind.size} values, not {len(value)}")
    if not isinstance(kind, Array) and kind.has_maximum_size() and len(value) > kind.maximum_size:
        raise RunError(f"{where} has at most {kind.maximum_size} values, not {len(value)}")
    items = [_value(item, one, None, f"{where}[{index}]", timed) for index, one in enumerate(value)]
    if isinstance(current, array):
        return array(current.typecode, items)
    if hasattr(current, "dtype"):
        return type(current)(len(items), dtype=current.dtype) if not items else _numbers(current, items)
    return items


def _numbers(current: Any, items: list[Any]) -> Any:  # noqa: ANN401 - an array of numpy
    import numpy as np  # noqa: PLC0415 - the message has brought it

    return np.array(items, dtype=current.dtype)


def _text(kind: Kind, value: Any, where: str) -> str:  # noqa: ANN401 - as above
    if isinstance(value, dict | list):
        raise RunError(f"{where} is a text, not {_shown(value)}")
    text = value if isinstance(value, str) else str(value)
    if kind.has_maximum_size() and len(text) > kind.maximum_size:
        raise RunError(f"{where} has at most {kind.maximum_size} characters, not {len(text)}")
    return text


def _basic(kind: Kind, value: Any, where: str) -> Any:  # noqa: ANN401 - as above
    name = kind.typename
    if name == "boolean":
        if isinstance(value, bool) or value in (0, 1):
            return bool(value)
        if isinstance(value, str) and value.lower() in _TRUTH:
            return _TRUTH[value.lower()]
    elif is_basic(kind, "octet"):
        return _byte(value, where)
    elif name in _BITS:
        return _integer(name, value, where)
    elif not isinstance(value, bool):
        try:
            return float(value)
        except (TypeError, ValueError):
            pass
    raise RunError(f"{where} is of type {name}, and {_shown(value)} is not")


def _integer(name: str, value: Any, where: str) -> int:  # noqa: ANN401 - as above
    try:
        number = int(value)
    except (TypeError, ValueError, OverflowError):
        number = None
    if number is None or (isinstance(value, float) and value != number):
        raise RunError(f"{where} is of type {name}, and {_shown(value)} is not")
    least, most = _BITS[name]
    if not least <= number <= most:
        raise RunError(f"{where} is of type {name}, from {least} to {most}: {number} is not")
    return number


def _byte(value: Any, where: str) -> bytes:  # noqa: ANN401 - as above
    if isinstance(value, bytes) and len(value) == 1:
        return value
    if isinstance(value, str) and len(value) == 1 and ord(value) < 256:  # noqa: PLR2004 - a byte
        return bytes([ord(value)])
    return bytes([_integer("uint8", value, where)])


def _class_of(kind: NamespacedType) -> Any:  # noqa: ANN401 - a class of an untyped package
    from orchestra.ros.interfaces.names import message_type  # noqa: PLC0415 - few messages hold lists of others

    return message_type(name_of(kind))


def _hint(name: str, known: Any) -> str:  # noqa: ANN401 - names of any kind of table
    near = nearest(name, known)
    return f"; did you mean {near}?" if near else f"; it has {', '.join(known)}" if known else ""


def _shown(value: object) -> str:
    return repr(value)
