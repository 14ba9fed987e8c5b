"""`composition_interfaces/srv/LoadNode` as a Python class, for where composition_interfaces is not installed."""

from __future__ import annotations

from typing import ClassVar

from rosidl_parser.definition import BasicType, NamespacedType, UnboundedSequence, UnboundedString

from orchestra.ros.interfaces import conversion, service_support
from orchestra.ros.interfaces.plain_message import MessageType, PlainMessage
from orchestra.ros.interfaces.service_support import Service

_PARAMETERS = UnboundedSequence(NamespacedType(["rcl_interfaces", "msg"], "Parameter"))
_SOURCE = """\
string package_name
string plugin_name
string node_name
string node_namespace
uint8 log_level
string[] remap_rules
rcl_interfaces/Parameter[] parameters
rcl_interfaces/Parameter[] extra_arguments
---
bool success
string error_message
string full_node_name
uint64 unique_id
"""


class _RequestType(MessageType):
    pass


class _ResponseType(MessageType):
    pass


class LoadNode_Request(PlainMessage, metaclass=_RequestType):  # noqa: N801  # as rosidl calls it
    """What to load, under which name, with which remaps and parameters."""

    _fields_and_field_types: ClassVar[dict[str, str]] = {
        "package_name": "string",
        "plugin_name": "string",
        "node_name": "string",
        "node_namespace": "string",
        "log_level": "uint8",
        "remap_rules": "sequence<string>",
        "parameters": "sequence<rcl_interfaces/Parameter>",
        "extra_arguments": "sequence<rcl_interfaces/Parameter>",
    }
    SLOT_TYPES = (
        *(UnboundedString() for _ in range(4)),
        BasicType("uint8"),
        UnboundedSequence(UnboundedString()),
        _PARAMETERS,
        _PARAMETERS,
    )


class LoadNode_Response(PlainMessage, metaclass=_ResponseType):  # noqa: N801  # as rosidl calls it
    """What became of it."""

    _fields_and_field_types: ClassVar[dict[str, str]] = {
        "success": "boolean",
        "error_message": "string",
        "full_node_name": "string",
        "unique_id": "uint64",
    }
    SLOT_TYPES = (BasicType("boolean"), UnboundedString(), UnboundedString(), BasicType("uint64"))


class LoadNodeType(type):
    """Metaclass of the service: holds the type support, as the metaclass of every ROS service does."""

    _TYPE_SUPPORT: object = None

    @classmethod
    def __import_type_support__(cls) -> None:
        """Make the type support, once; rclpy calls this when the class is first used."""
        if cls._TYPE_SUPPORT is None:
            cls._TYPE_SUPPORT = conversion.capsule(service_support.build(_SERVICE))


class LoadNode(metaclass=LoadNodeType):
    """Service class 'LoadNode'; cannot be instantiated, as no service class can."""

    Request = LoadNode_Request
    Response = LoadNode_Response


_SERVICE = Service("composition_interfaces", "LoadNode", LoadNode_Request, LoadNode_Response, _SOURCE)

# Generic tools read a type's package from here; there need be no such module.
for _kind in (LoadNode, LoadNode_Request, LoadNode_Response):
    _kind.__module__ = "composition_interfaces.srv._load_node"
