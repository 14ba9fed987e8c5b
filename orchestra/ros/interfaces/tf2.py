"""`tf2_msgs/msg/TFMessage` as a Python class, for where the package tf2_msgs is not installed."""

from __future__ import annotations

import ctypes
import os
from collections.abc import Sequence, Set
from typing import Any

from geometry_msgs.msg import TransformStamped
from rosidl_parser.definition import NamespacedType, UnboundedSequence

from orchestra.ros.interfaces import conversion, typesupport

_CHECK_FIELDS = os.environ.get("ROS_PYTHON_CHECK_FIELDS") == "1"


class TFMessageType(type):
    """Metaclass of TFMessage: holds the type support, as the metaclass of every ROS message does."""

    _CREATE_ROS_MESSAGE: object = None
    _CONVERT_FROM_PY: object = None
    _CONVERT_TO_PY: object = None
    _DESTROY_ROS_MESSAGE: object = None
    _TYPE_SUPPORT: object = None

    @classmethod
    def __import_type_support__(cls) -> None:
        """Make the type support; rclpy calls this when the class is first used."""
        element = type(TransformStamped)
        if element._TYPE_SUPPORT is None:
            element.__import_type_support__()
        finish_string = ctypes.PyDLL("librosidl_runtime_c.so").rosidl_runtime_c__String__fini
        functions = conversion.capsules(_from_transforms, TransformStamped, finish_string)
        for name, function in functions.items():
            setattr(cls, name, function)
        cls._TYPE_SUPPORT = conversion.capsule(typesupport.build(conversion.address_in(element._TYPE_SUPPORT)))


class TFMessage(metaclass=TFMessageType):
    """Message class 'TFMessage': a list of transforms between frames."""

    __slots__ = ("_check_fields", "_transforms")

    _fields_and_field_types = {"transforms": "sequence<geometry_msgs/TransformStamped>"}

    SLOT_TYPES = (UnboundedSequence(NamespacedType(["geometry_msgs", "msg"], "TransformStamped")),)

    def __init__(self, **fields: Any) -> None:
        self._check_fields: bool = fields.pop("check_fields", _CHECK_FIELDS)
        if self._check_fields:
            unknown = sorted(fields.keys() - self._fields_and_field_types)
            assert not unknown, f"Invalid arguments passed to constructor: {', '.join(unknown)}"
        self.transforms = fields.get("transforms", [])

    def __repr__(self) -> str:
        return f"tf2_msgs.msg.TFMessage(transforms={self._transforms!r})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, TFMessage) and bool(self._transforms == other._transforms)

    __hash__ = None  # type: ignore[assignment]  # as every ROS message: equal by value and mutable

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]:
        """Each field's name and type, in order."""
        return dict(cls._fields_and_field_types)

    @property
    def transforms(self) -> Any:
        """Message field 'transforms'."""
        return self._transforms

    @transforms.setter
    def transforms(self, value: Any) -> None:
        if self._check_fields:
            assert (
                isinstance(value, (Sequence, Set))
                and not isinstance(value, str)
                and all(isinstance(item, TransformStamped) for item in value)
            ), "The 'transforms' field must be a set or sequence and each value of type 'TransformStamped'"
        self._transforms = value


# Generic tools (message to YAML, `topic list -t`) read the package from the module's name.
TFMessage.__module__ = "tf2_msgs.msg._tf_message"


def _from_transforms(transforms: list[Any]) -> TFMessage:
    return TFMessage(transforms=transforms)
