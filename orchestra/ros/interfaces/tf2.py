"""`tf2_msgs/msg/TFMessage` as a Python class, for where the package tf2_msgs is not installed."""

from __future__ import annotations

import logging
import os
from collections.abc import Sequence
from collections.abc import Set as AbstractSet
from typing import Any

from geometry_msgs.msg import TransformStamped
from rosidl_parser.definition import NamespacedType, UnboundedSequence

from orchestra.ros.interfaces import conversion, typesupport, wire

_log = logging.getLogger(__name__)

_CHECK_FIELDS = os.environ.get("ROS_PYTHON_CHECK_FIELDS") == "1"

Transforms = Any  # a sequence of a class without type information


class TFMessageType(type):
    """Metaclass of TFMessage: holds the type support, as the metaclass of every ROS message does."""

    _CREATE_ROS_MESSAGE: object = None
    _CONVERT_FROM_PY: object = None
    _CONVERT_TO_PY: object = None
    _DESTROY_ROS_MESSAGE: object = None
    _TYPE_SUPPORT: object = None

    @classmethod
    def __import_type_support__(cls) -> None:
        """Make the type support, once; rclpy calls this when the class is first used."""
        if cls._TYPE_SUPPORT is not None:
            return
        element = type(TransformStamped)
        if element._TYPE_SUPPORT is None:  # noqa: SLF001  # the convention of every ROS message
            element.__import_type_support__()
        of_element = element._TYPE_SUPPORT  # noqa: SLF001  # as above
        support = typesupport.build(conversion.address_in(of_element), _TFMessageInTransit)
        for name, function in conversion.capsules(_TFMessageInTransit).items():
            setattr(cls, name, function)
        cls._TYPE_SUPPORT = conversion.capsule(support)


class TFMessage(metaclass=TFMessageType):
    """Message class 'TFMessage': a list of transforms between frames."""

    __slots__ = ("_check_fields", "_transforms")

    _fields_and_field_types = {"transforms": "sequence<geometry_msgs/TransformStamped>"}  # noqa: RUF012  # as in every message class

    # Generic tools (message to YAML and back) read the fields' types here.
    SLOT_TYPES = (UnboundedSequence(NamespacedType(["geometry_msgs", "msg"], "TransformStamped")),)

    def __init__(self, *, check_fields: bool = _CHECK_FIELDS, **fields: Transforms) -> None:
        self._check_fields = check_fields
        unknown = sorted(fields.keys() - self._fields_and_field_types)
        if check_fields and unknown:
            raise AssertionError(f"Invalid arguments passed to constructor: {', '.join(unknown)}")
        self.transforms = fields.get("transforms", [])

    def __repr__(self) -> str:
        return f"tf2_msgs.msg.TFMessage(transforms={self._transforms!r})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, TFMessage) and bool(self._transforms == other._transforms)

    __hash__ = None  # type: ignore[assignment]  # equal by value and mutable, as every ROS message

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]:
        """Return each field's type by its name."""
        return dict(cls._fields_and_field_types)

    @property
    def transforms(self) -> Transforms:
        """Message field 'transforms'."""
        return self._transforms

    @transforms.setter
    def transforms(self, value: Transforms) -> None:
        if self._check_fields and not _is_transforms(value):
            raise AssertionError(
                "The 'transforms' field must be a set or sequence and each value of type 'TransformStamped'"
            )
        self._transforms = value


# Generic tools read a message's package from here; there need be no such module.
TFMessage.__module__ = "tf2_msgs.msg._tf_message"


class _TFMessageInTransit(conversion.MessageInTransit):
    type_name = "TFMessage"

    def encode(self, source: Transforms) -> bytes:
        return wire.encode(source.transforms)

    def __call__(self) -> TFMessage:
        """Return the message that came in; an empty one, with a record in the log, if it is malformed.

        Raising here would leave rclpy's executor unable to serve the subscription again.
        """
        try:
            transforms = conversion.uninterrupted(wire.decode, self.serialized(), TransformStamped)
        except wire.MalformedMessageError as error:
            _log.error("a malformed TFMessage came in, taken as an empty one: %s", error)
            transforms = []
        return TFMessage(transforms=transforms)


def _is_transforms(value: object) -> bool:
    return (
        isinstance(value, (Sequence, AbstractSet))
        and not isinstance(value, str)
        and all(isinstance(item, TransformStamped) for item in value)
    )
