"""The fields of a message as the middleware wants to know them: for descriptions and for introspection.

Sources: `FieldType.msg` of type_description_interfaces (REP 2011), `field_types.h` of
rosidl_typesupport_introspection_c. Only what the types that are made here need.
"""

from __future__ import annotations

from typing import Any

from rosidl_parser.definition import (
    AbstractGenericString,
    AbstractSequence,
    BasicType,
    BoundedSequence,
    NamespacedType,
)

from orchestra.ros.interfaces.layouts import Field, FieldType, Member, text

_BOUNDED, _UNBOUNDED = 96, 144
_STRING, _NESTED = 17, 1
_DESCRIBED = {"uint8": 3, "uint64": 9, "boolean": 15}

_ROS_TYPE_STRING, _ROS_TYPE_MESSAGE = 16, 18
_INTROSPECTED = {"boolean": 6, "uint8": 8, "uint64": 14}


def described(name: str, kind: Any) -> Field:  # noqa: ANN401 - a type of rosidl_parser
    """Return the description of a field."""
    offset = capacity = 0
    if isinstance(kind, BoundedSequence):
        offset, capacity, kind = _BOUNDED, kind.maximum_size, kind.value_type
    elif isinstance(kind, AbstractSequence):
        offset, kind = _UNBOUNDED, kind.value_type
    nested = b""
    if isinstance(kind, NamespacedType):
        number, nested = _NESTED, "/".join([*kind.namespaces, kind.name]).encode()
    elif isinstance(kind, AbstractGenericString):
        number = _STRING
    else:
        number = _DESCRIBED[kind.typename]
    what = FieldType(offset + number, capacity, 0, text(nested))
    return Field(text(name.encode()), what, text(b""))


def introspected(name: str, kind: Any, handles: dict[str, int]) -> Member:  # noqa: ANN401 - as above
    """Return a field for introspection; `handles` has the introspection handle of each nested type by its name."""
    is_array = isinstance(kind, AbstractSequence)
    kind = kind.value_type if is_array else kind
    if isinstance(kind, BasicType):
        return Member(name=name.encode(), type_id=_INTROSPECTED[kind.typename], is_array=is_array)
    if isinstance(kind, NamespacedType):
        nested = handles["/".join([*kind.namespaces, kind.name])]
        return Member(name=name.encode(), type_id=_ROS_TYPE_MESSAGE, members=nested, is_array=is_array)
    return Member(name=name.encode(), type_id=_ROS_TYPE_STRING, is_array=is_array)
