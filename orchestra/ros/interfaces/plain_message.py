"""Message classes that are made here: fields by their types, equality by value, nothing checked but the names."""

from __future__ import annotations

from typing import Any, ClassVar

from orchestra.ros.interfaces import cdr, conversion
from orchestra.ros.interfaces.wire import MalformedMessageError

_DEFAULTS: dict[str, Any] = {"string": "", "boolean": False, "uint8": 0, "uint64": 0}


def _default(kind: str) -> Any:  # noqa: ANN401 - each field has a type of its own
    return _DEFAULTS.get(kind, [])


class MessageType(type):
    """Metaclass of a message: rclpy looks for its functions and its type support there, so each message has its own."""

    _CREATE_ROS_MESSAGE: object = None
    _CONVERT_FROM_PY: object = None
    _CONVERT_TO_PY: object = None
    _DESTROY_ROS_MESSAGE: object = None
    _TYPE_SUPPORT: object = None

    @classmethod
    def take(cls, support: int, transit: type[conversion.MessageInTransit]) -> None:
        """Take the type support at an address, and the functions for messages in transit."""
        for name, function in conversion.capsules(transit).items():
            setattr(cls, name, function)
        cls._TYPE_SUPPORT = conversion.capsule(support)


class PlainMessage:
    """A message with `SLOT_TYPES` and `_fields_and_field_types`, as every ROS message class has them."""

    SLOT_TYPES: ClassVar[tuple[Any, ...]] = ()
    _fields_and_field_types: ClassVar[dict[str, str]] = {}

    def __init__(self, **fields: Any) -> None:  # noqa: ANN401 - each field has a type of its own
        unknown = sorted(fields.keys() - self._fields_and_field_types)
        if unknown:
            raise AssertionError(f"Invalid arguments passed to constructor: {', '.join(unknown)}")
        for name, kind in self._fields_and_field_types.items():
            setattr(self, name, fields[name] if name in fields else _default(kind))

    def __repr__(self) -> str:
        fields = ", ".join(f"{name}={getattr(self, name)!r}" for name in self._fields_and_field_types)
        return f"{type(self).__module__}.{type(self).__qualname__}({fields})"

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and vars(other) == vars(self)

    __hash__ = None  # type: ignore[assignment]  # equal by value and mutable, as every ROS message

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]:
        """Return each field's type by its name."""
        return dict(cls._fields_and_field_types)


def transit_of(kind: type[PlainMessage]) -> type[conversion.MessageInTransit]:
    """Return the class of the objects that stand for messages of a class on their way."""

    class InTransit(conversion.MessageInTransit):
        type_name = kind.__name__

        def encode(self, source: object) -> bytes:
            return cdr.encode(source)

        def __call__(self) -> object:
            """Return what came in; an empty message, with a record in the log, if it is malformed."""
            try:
                return conversion.uninterrupted(cdr.decode, self.serialized(), kind)
            except MalformedMessageError as error:
                conversion.log.error(
                    "a malformed %s came in, taken as an empty one: %s", kind.__name__, error
                )
                return kind()

    return InTransit
