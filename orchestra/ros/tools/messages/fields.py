"""The fields of a message class with their types, as the generated classes and those made here have them."""

from __future__ import annotations

from functools import cache
from typing import Any

from rosidl_parser.definition import (
    AbstractNestedType,
    AbstractString,
    AbstractWString,
    BasicType,
    NamespacedType,
)

# A class, or a type of a field, of packages without type information.
Class = Any
Kind = Any


@cache
def _fields(kind: Class) -> tuple[tuple[str, Kind], ...]:
    return tuple(zip(kind.get_fields_and_field_types(), kind.SLOT_TYPES, strict=True))


def fields_of(kind: Class) -> tuple[tuple[str, Kind], ...]:
    """Return the names of the fields in the order of the definition, with their types."""
    return _fields(kind)


def is_message(value: object) -> bool:
    """Tell whether a value is a message."""
    return hasattr(value, "get_fields_and_field_types")


def is_nested(kind: Kind) -> bool:
    """Tell whether a type has several values: an array or a sequence."""
    return isinstance(kind, AbstractNestedType)


def is_text(kind: Kind) -> bool:
    """Tell whether a type is one of text."""
    return isinstance(kind, AbstractString | AbstractWString)


def is_basic(kind: Kind, name: str) -> bool:
    """Tell whether a type is the basic one of this name."""
    return isinstance(kind, BasicType) and kind.typename == name


def name_of(kind: Kind) -> str:
    """Return the name of a type of one value, as definitions write it."""
    if isinstance(kind, NamespacedType):
        return "/".join([*kind.namespaces, kind.name])
    if isinstance(kind, AbstractString):
        return "string"
    return "wstring" if isinstance(kind, AbstractWString) else str(kind.typename)
