"""Message classes as rosidl_generator_py makes them: slots behind properties, checks on demand, equality by value."""

from __future__ import annotations

import os
from array import array
from typing import TYPE_CHECKING, Any, NamedTuple

from rosidl_parser.definition import (
    EMPTY_STRUCTURE_REQUIRED_MEMBER_NAME,
    AbstractSequence,
    Array,
)

from orchestra.ros.interfaces.made import checks, values
from orchestra.ros.interfaces.slots import TYPE_CODES

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from orchestra.ros.interfaces.made.values import Kind

_CHECK_FIELDS = os.environ.get("ROS_PYTHON_CHECK_FIELDS") == "1"

_TYPE_SUPPORT = (
    "_CREATE_ROS_MESSAGE",
    "_CONVERT_FROM_PY",
    "_CONVERT_TO_PY",
    "_DESTROY_ROS_MESSAGE",
    "_TYPE_SUPPORT",
)


class Field(NamedTuple):
    """A field: its name, its type, the default value of the definition and what makes its first value."""

    name: str
    kind: Kind
    default: Any
    first: Callable[[], Any]


def message_class(message: Any, module: str, import_type_support: Callable[[Any], None]) -> Any:  # noqa: ANN401 - a class of rosidl_parser; a class
    """Return the class of a message that a definition describes.

    `module` is where it says it comes from. `import_type_support` is called with the class, once, when rclpy first
    uses it.
    """
    fields = fields_of(message)
    name = message.structure.namespaced_type.name
    constants = {found.name: _constant(found) for found in message.constants}
    made: list[Any] = []
    metaclass = _metaclass(name, constants, fields, lambda: import_type_support(*made))
    defaults = {_default_name(field): field.first() for field in fields if field.default is not None}
    content = {
        "__module__": module,
        "__doc__": _documentation(name, constants),
        "__slots__": [*(f"_{field.name}" for field in fields), "_check_fields"],
        "_fields_and_field_types": {field.name: values.shown(field.kind) for field in fields},
        "SLOT_TYPES": tuple(field.kind for field in fields),
        "__init__": _constructor(fields),
        "__repr__": _repr,
        "__eq__": _equality(fields),
        "get_fields_and_field_types": classmethod(_told),
        **{field.name: _property(field) for field in fields},
    }
    made.append(metaclass(name, (), constants | defaults | content))
    return made[0]


def fields_of(message: Any) -> list[Field]:  # noqa: ANN401 - as above
    """Return the fields of a message; one that rosidl adds where there is none is none."""
    found = []
    for member in message.structure.members:
        default = (
            member.get_annotation_value("default")["value"] if member.has_annotation("default") else None
        )
        found.append(Field(member.name, member.type, default, values.first_value(member.type, default)))
    if len(found) == 1 and found[0].name == EMPTY_STRUCTURE_REQUIRED_MEMBER_NAME:
        return []
    return found


def _constant(found: Any) -> Any:  # noqa: ANN401 - as above
    return values.single(found.type, found.value)


def _default_name(field: Field) -> str:
    return f"{field.name.upper()}__DEFAULT"


def _metaclass(
    name: str,
    constants: Mapping[str, Any],
    fields: list[Field],
    import_type_support: Callable[[], None],
) -> Any:  # noqa: ANN401 - a class
    """Return the metaclass, where rclpy looks for the type support; through it a class's constants cannot be set."""

    def of_class(cls: Any) -> None:  # noqa: ANN401 - as above
        if cls._TYPE_SUPPORT is None:
            import_type_support()

    content: dict[str, Any] = dict.fromkeys(_TYPE_SUPPORT)
    content["__doc__"] = f"Metaclass of message '{name}'."
    content["__import_type_support__"] = classmethod(of_class)
    for constant, value in constants.items():
        content[constant] = property(_always(value), doc=f"Message constant '{constant}'.")
    for field in fields:
        if field.default is not None:
            doc = f"Return default value for message field '{field.name}'."
            content[_default_name(field)] = property(_made_by(field.first), doc=doc)
    return type(f"Metaclass_{name}", (type,), content)


def _always(value: Any) -> Callable[[Any], Any]:  # noqa: ANN401 - as above
    return lambda _: value


def _made_by(make: Callable[[], Any]) -> Callable[[Any], Any]:
    return lambda _: make()


def _documentation(name: str, constants: Mapping[str, Any]) -> str:
    first = f"Message class '{name}'."
    if not constants:
        return first
    return "\n".join(
        [f"\n    {first}\n\n    Constants:", *(f"      {constant}" for constant in constants), "    "]
    )


def _constructor(fields: list[Field]) -> Callable[..., None]:
    def __init__(self: Any, **kwargs: Any) -> None:  # noqa: ANN401, N807 - the method of a class
        self._check_fields = kwargs.get("check_fields", _CHECK_FIELDS)
        if self._check_fields:
            unknown = sorted(key for key in kwargs if f"_{key}" not in self.__slots__)
            if unknown:
                raise AssertionError(f"Invalid arguments passed to constructor: {', '.join(unknown)}")
        for field in fields:
            name = field.name
            if name not in kwargs:
                setattr(self, f"_{name}", field.first())
            elif values.is_compact(field.kind) and isinstance(field.kind, AbstractSequence):
                setattr(self, name, array(TYPE_CODES[field.kind.value_type.typename], kwargs[name]))
            else:
                setattr(self, name, kwargs[name])

    return __init__


def _property(field: Field) -> property:
    slot, kind = f"_{field.name}", field.kind
    check = checks.check_of(field.name, kind)
    converted = _conversion(kind)

    def get(self: Any) -> Any:  # noqa: ANN401 - as above
        return getattr(self, slot)

    def set_(self: Any, value: Any) -> None:  # noqa: ANN401 - as above
        if self._check_fields:
            if checks.taken_as_it_is(field.name, kind, value):
                setattr(self, slot, value)
                return
            check(value)
        setattr(self, slot, converted(value))

    return property(get, set_, doc=f"Message field '{field.name}'.")


def _conversion(kind: Kind) -> Callable[[Any], Any]:
    if not values.is_compact(kind):
        return lambda value: value
    if isinstance(kind, Array):
        return lambda value: values.numpy_array(kind, value)
    code = TYPE_CODES[kind.value_type.typename]
    return lambda value: array(code, value)


def _repr(self: Any) -> str:  # noqa: ANN401 - as above
    package_and_kind = type(self).__module__.rpartition(".")[0]
    fields = zip(self.get_fields_and_field_types(), self.SLOT_TYPES, strict=True)
    shown = ", ".join(f"{name}={_shown(getattr(self, name), kind)}" for name, kind in fields)
    return f"{package_and_kind}.{type(self).__name__}({shown})"


def _shown(value: Any, kind: Kind) -> str:  # noqa: ANN401 - as above
    """Return a value as text; an `array.array` as its list."""
    if isinstance(kind, AbstractSequence) and values.is_compact(kind):
        return repr(value.tolist() if isinstance(value, array) else value)
    return repr(value)


def _equality(fields: list[Field]) -> Callable[[Any, object], bool]:
    plain = [f"_{field.name}" for field in fields if not _is_numpy(field.kind)]
    numpy = [f"_{field.name}" for field in fields if _is_numpy(field.kind)]

    def __eq__(self: Any, other: object) -> bool:  # noqa: ANN401, N807 - the method of a class
        if not isinstance(other, type(self)):
            return False
        return all(getattr(self, slot) == getattr(other, slot) for slot in plain) and all(
            all(getattr(self, slot) == getattr(other, slot)) for slot in numpy
        )

    return __eq__


def _is_numpy(kind: Kind) -> bool:
    return isinstance(kind, Array) and values.is_compact(kind)


def _told(cls: Any) -> dict[str, str]:  # noqa: ANN401 - as above
    return dict(cls._fields_and_field_types)
