"""The fields of a message as the middleware wants to know them: for descriptions and for introspection.

Sources: `FieldType.msg` of type_description_interfaces (REP 2011), `field_types.h` of
rosidl_typesupport_introspection_c.
"""

from __future__ import annotations

from typing import Any, Final

from rosidl_parser.definition import (
    AbstractGenericString,
    AbstractNestedType,
    AbstractWString,
    Array,
    BasicType,
    BoundedSequence,
    NamespacedType,
    UnboundedSequence,
)

from orchestra.ros.interfaces.layouts import Field, FieldType, Member, text

_COLLECTIONS: Final = {Array: 48, BoundedSequence: 96, UnboundedSequence: 144}
_NESTED: Final = 1
_STRINGS: Final = {False: 17, True: 18}
_BOUNDED_STRINGS: Final = {False: 21, True: 22}
_DESCRIBED: Final = {
    "int8": 2,
    "uint8": 3,
    "int16": 4,
    "uint16": 5,
    "int32": 6,
    "uint32": 7,
    "int64": 8,
    "uint64": 9,
    "float": 10,
    "double": 11,
    "char": 13,
    "wchar": 14,
    "boolean": 15,
    "octet": 16,
}

_ROS_TYPE_STRING, _ROS_TYPE_WSTRING, _ROS_TYPE_MESSAGE = 16, 17, 18
_INTROSPECTED: Final = {
    "float": 1,
    "double": 2,
    "char": 4,
    "wchar": 5,
    "boolean": 6,
    "octet": 7,
    "uint8": 8,
    "int8": 9,
    "uint16": 10,
    "int16": 11,
    "uint32": 12,
    "int32": 13,
    "uint64": 14,
    "int64": 15,
}


def full_name(name: NamespacedType) -> str:
    """Return the name of a type as in the graph."""
    return "/".join([*name.namespaces, name.name])


def described(name: str, kind: Any, default: str = "") -> Field:  # noqa: ANN401 - a type of rosidl_parser
    """Return the description of a field."""
    item = _item(kind)
    nested = full_name(item).encode() if isinstance(item, NamespacedType) else b""
    number = _COLLECTIONS.get(type(kind), 0) + _described_item(item)
    what = FieldType(number, _capacity(kind), _string_capacity(item), text(nested))
    return Field(text(name.encode()), what, text(default.encode()))


def _described_item(item: Any) -> int:  # noqa: ANN401 - as above
    if isinstance(item, NamespacedType):
        return _NESTED
    if isinstance(item, AbstractGenericString):
        numbers = _BOUNDED_STRINGS if item.has_maximum_size() else _STRINGS
        return numbers[isinstance(item, AbstractWString)]
    return _DESCRIBED[item.typename]


def _item(kind: Any) -> Any:  # noqa: ANN401 - as above
    return kind.value_type if isinstance(kind, AbstractNestedType) else kind


def _capacity(kind: Any) -> int:  # noqa: ANN401 - as above
    if isinstance(kind, Array):
        return int(kind.size)
    return int(kind.maximum_size) if isinstance(kind, BoundedSequence) else 0


def _string_capacity(item: Any) -> int:  # noqa: ANN401 - as above
    return item.maximum_size if isinstance(item, AbstractGenericString) and item.has_maximum_size() else 0


def introspected(name: str, kind: Any, handles: dict[str, int]) -> Member:  # noqa: ANN401 - as above
    """Return a field for introspection; `handles` has the introspection handle of each nested type by its name."""
    item = _item(kind)
    member = Member(
        name=name.encode(),
        string_upper_bound=_string_capacity(item),
        is_array=isinstance(kind, AbstractNestedType),
        array_size=_capacity(kind),
        is_upper_bound=isinstance(kind, BoundedSequence),
    )
    if isinstance(item, BasicType):
        member.type_id = _INTROSPECTED[item.typename]
    elif isinstance(item, NamespacedType):
        member.type_id, member.members = _ROS_TYPE_MESSAGE, handles[full_name(item)]
    else:
        member.type_id = _ROS_TYPE_WSTRING if isinstance(item, AbstractWString) else _ROS_TYPE_STRING
    return member
