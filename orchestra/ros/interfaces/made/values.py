"""The values of fields by their types: which Python type stands for which, and what a field holds at first."""

from __future__ import annotations

import ast
from array import array
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from rosidl_parser.definition import (
    AbstractGenericString,
    AbstractNestedType,
    AbstractWString,
    Array,
    BasicType,
    BoundedSequence,
    NamespacedType,
)

from orchestra.ros.interfaces.slots import TYPE_CODES, class_of

if TYPE_CHECKING:
    from collections.abc import Callable

Kind = Any  # a type of rosidl_parser, which has no type information

DTYPES: Final = {"float": "float32", "double": "float64"}  # those of integers are called as in the definition
_PYTHON: Final = {"boolean": bool, "octet": bytes, "char": str, "wchar": str, "float": float, "double": float}


def item_of(kind: Kind) -> Kind:
    """Return the type of the items of an array or sequence, else the type itself."""
    return kind.value_type if isinstance(kind, AbstractNestedType) else kind


def is_compact(kind: Kind) -> bool:
    """Tell whether a field is an `array.array`, or a numpy array where its size is fixed."""
    return (
        isinstance(kind, AbstractNestedType)
        and isinstance(kind.value_type, BasicType)
        and kind.value_type.typename in TYPE_CODES
    )


def python_type(item: Kind) -> type:
    """Return the Python type of a single value that is not a message."""
    return str if isinstance(item, AbstractGenericString) else _PYTHON.get(item.typename, int)


def shown(kind: Kind) -> str:
    """Return a type as `get_fields_and_field_types` tells it."""
    text = _shown_item(item_of(kind))
    if isinstance(kind, Array):
        return f"{text}[{kind.size}]"
    if isinstance(kind, BoundedSequence):
        return f"sequence<{text}, {kind.maximum_size}>"
    return f"sequence<{text}>" if isinstance(kind, AbstractNestedType) else text


def _shown_item(item: Kind) -> str:
    if isinstance(item, NamespacedType):
        return f"{item.namespaces[0]}/{item.name}"
    if isinstance(item, BasicType):
        return str(item.typename)
    text = "wstring" if isinstance(item, AbstractWString) else "string"
    return f"{text}<{item.maximum_size}>" if item.has_maximum_size() else text


def numpy_array(kind: Array, value: object = None) -> Any:  # noqa: ANN401 - numpy is imported when it is needed
    """Return the numpy array of a field of fixed size: of a value, else zeros."""
    import numpy as np  # noqa: PLC0415 - few messages have such fields

    dtype = np.dtype(DTYPES.get(kind.value_type.typename, kind.value_type.typename))
    return np.zeros(kind.size, dtype) if value is None else np.array(value, dtype)


def first_value(kind: Kind, default: Any) -> Callable[[], Any]:  # noqa: ANN401 - a value of any type
    """Return what makes the value that a field has at first; `default` is as rosidl_parser has it, or None."""
    if default is not None:
        return _given(kind, default)
    item = item_of(kind)
    if is_compact(kind):
        if isinstance(kind, Array):
            return partial(numpy_array, kind)
        return partial(array, TYPE_CODES[item.typename])
    one = partial(_made, item) if isinstance(item, NamespacedType) else _constant(_nothing(item))
    if isinstance(kind, Array):
        return lambda: [one() for _ in range(kind.size)]
    return list if isinstance(kind, AbstractNestedType) else one


def _made(name: NamespacedType) -> Any:  # noqa: ANN401 - a message
    return class_of(name)()


def _nothing(item: Kind) -> Any:  # noqa: ANN401 - as above
    if isinstance(item, BasicType) and item.typename == "octet":
        return b"\0"
    if isinstance(item, BasicType) and item.typename in ("char", "wchar"):
        return "\0"
    return python_type(item)()


def _given(kind: Kind, default: Any) -> Callable[[], Any]:  # noqa: ANN401 - as above
    item = item_of(kind)
    if not isinstance(kind, AbstractNestedType):
        return _constant(single(item, default))
    values = [single(item, value) for value in ast.literal_eval(default)]
    if not is_compact(kind):
        return values.copy
    if isinstance(kind, Array):
        return partial(numpy_array, kind, values)
    return partial(array, TYPE_CODES[item.typename], values)


def single(item: Kind, value: Any) -> Any:  # noqa: ANN401 - as above
    """Return a value of a definition as Python has it in a message."""
    if isinstance(item, BasicType):
        if item.typename == "octet":
            return bytes([value])
        if item.typename in ("char", "wchar") and isinstance(value, int):
            return chr(value)
        return python_type(item)(value)
    return value


def _constant(value: Any) -> Callable[[], Any]:  # noqa: ANN401 - as above
    return lambda: value
