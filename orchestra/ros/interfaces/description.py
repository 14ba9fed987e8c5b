"""The description of TFMessage for the graph and for `get_type_description`, and the hash over it (REP 2011)."""

from __future__ import annotations

import ctypes
import hashlib
import json
from typing import Any, TypeVar

from orchestra.ros.interfaces.layouts import (
    Field,
    FieldType,
    IndividualType,
    String,
    TypeDescription,
    TypeHash,
    TypeSource,
    sequence,
    text,
)

_RIHS_VERSION = 1
_NESTED_TYPE_UNBOUNDED_SEQUENCE = 145  # type_description_interfaces/msg/FieldType

_Item = TypeVar("_Item", bound=ctypes.Structure)

NAME = b"tf2_msgs/msg/TFMessage"
ELEMENT = b"geometry_msgs/msg/TransformStamped"
SOURCE = b"geometry_msgs/TransformStamped[] transforms\n"


def describe(element: TypeDescription) -> TypeDescription:
    """Describe TFMessage, given that of its element; it shares the element's tables."""
    nested = FieldType(type_id=_NESTED_TYPE_UNBOUNDED_SEQUENCE, nested_type_name=text(ELEMENT))
    fields = [Field(text(b"transforms"), nested, text(b""))]
    referenced = [*items(element.referenced_type_descriptions, IndividualType), element.type_description]
    return TypeDescription(
        IndividualType(text(NAME), sequence(Field, fields)),
        sequence(IndividualType, sorted(referenced, key=lambda item: string(item.type_name))),
    )


def sources(element: String) -> String:
    """Return the sequence of definition files: that of TFMessage, then those that its element needs."""
    return sequence(
        TypeSource, [TypeSource(text(NAME), text(b"msg"), text(SOURCE)), *items(element, TypeSource)]
    )


def type_hash(description: TypeDescription) -> TypeHash:
    """Return the RIHS01 hash: SHA-256 over the description as JSON, without default values."""
    content = {
        "type_description": _individual_type(description.type_description),
        "referenced_type_descriptions": [
            _individual_type(item) for item in items(description.referenced_type_descriptions, IndividualType)
        ],
    }
    digest = hashlib.sha256(json.dumps(content).encode()).digest()
    return TypeHash(_RIHS_VERSION, (ctypes.c_uint8 * 32)(*digest))


def items(found: String, kind: type[_Item]) -> list[_Item]:
    """Return the items of a rosidl sequence."""
    return [kind.from_address(found.data + index * ctypes.sizeof(kind)) for index in range(found.size)]


def string(value: String) -> str:
    """Return the text of a rosidl string."""
    return ctypes.string_at(value.data, value.size).decode()


def _individual_type(item: IndividualType) -> dict[str, Any]:
    return {
        "type_name": string(item.type_name),
        "fields": [
            {
                "name": string(field.name),
                "type": {
                    "type_id": field.type.type_id,
                    "capacity": field.type.capacity,
                    "string_capacity": field.type.string_capacity,
                    "nested_type_name": string(field.type.nested_type_name),
                },
            }
            for field in items(item.fields, Field)
        ],
    }
