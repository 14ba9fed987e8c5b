"""The fields of message classes, those of the wheels and those made here: their names, types and the types' classes."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from rosidl_parser.definition import NamespacedType

# The numbers of which a sequence is an `array.array`: the code of both `array` and `struct`.
TYPE_CODES: Final = {
    "float": "f",
    "double": "d",
    "int8": "b",
    "uint8": "B",
    "int16": "h",
    "uint16": "H",
    "int32": "i",
    "uint32": "I",
    "int64": "q",
    "uint64": "Q",
}
_PARTS_OF_ACTIONS: Final = ("_Goal", "_Result", "_Feedback")


def fields_of(kind: Any) -> list[tuple[str, Any]]:  # noqa: ANN401 - a message class, untyped
    """Return the names and types of the fields of a message class."""
    return list(zip(kind.get_fields_and_field_types(), kind.SLOT_TYPES, strict=True))


def class_of(name: NamespacedType) -> Any:  # noqa: ANN401 - as above
    """Return the class of a message type."""
    module = ".".join(name.namespaces)
    if name.namespaces[-1] == "action" and name.name.endswith(_PARTS_OF_ACTIONS):
        action, _, part = name.name.rpartition("_")
        return getattr(getattr(import_module(module), action), part)
    return getattr(import_module(module), name.name)
