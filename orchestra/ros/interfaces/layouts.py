"""The C structures of ROS 2 Jazzy that a type support is made of.

Sources: the headers `message_type_support_struct.h`, `type_hash.h` and `type_description/*__struct.h` of
rosidl_runtime_c, `message_introspection.h` of rosidl_typesupport_introspection_c, `message_type_support.h` of
rosidl_typesupport_fastrtps_cpp, their counterparts for services, `Cdr.h` and `FastBuffer.h` of Fast CDR 2. The private
part of Fast CDR that is used here is checked against the library itself when a type support is made (see
`typesupport`).
"""

from __future__ import annotations

import ctypes
from ctypes import POINTER, Structure, c_bool, c_char_p, c_size_t, c_uint8, c_uint32, c_uint64, c_void_p
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from collections.abc import Sequence

_Value = TypeVar("_Value")


class Bytes(Structure):
    """A pointer and a length."""

    _fields_ = (("data", c_void_p), ("size", c_size_t))


class String(Structure):
    """`rosidl_runtime_c__String`; also what every sequence looks like."""

    _fields_ = (("data", c_void_p), ("size", c_size_t), ("capacity", c_size_t))


class TypeHash(Structure):
    """`rosidl_type_hash_t`."""

    _fields_ = (("version", c_uint8), ("value", c_uint8 * 32))


class FieldType(Structure):
    """`rosidl_runtime_c__type_description__FieldType`."""

    _fields_ = (
        ("type_id", c_uint8),
        ("capacity", c_uint64),
        ("string_capacity", c_uint64),
        ("nested_type_name", String),
    )


class Field(Structure):
    """`rosidl_runtime_c__type_description__Field`."""

    _fields_ = (("name", String), ("type", FieldType), ("default_value", String))


class IndividualType(Structure):
    """`rosidl_runtime_c__type_description__IndividualTypeDescription`."""

    _fields_ = (("type_name", String), ("fields", String))


class TypeDescription(Structure):
    """`rosidl_runtime_c__type_description__TypeDescription`."""

    _fields_ = (("type_description", IndividualType), ("referenced_type_descriptions", String))


class TypeSource(Structure):
    """`rosidl_runtime_c__type_description__TypeSource`."""

    _fields_ = (("type_name", String), ("encoding", String), ("raw_file_contents", String))


class Handle(Structure):
    """`rosidl_message_type_support_t`."""

    _fields_ = (
        ("typesupport_identifier", c_char_p),
        ("data", c_void_p),
        ("func", c_void_p),
        ("get_type_hash_func", c_void_p),
        ("get_type_description_func", c_void_p),
        ("get_type_description_sources_func", c_void_p),
    )


class Callbacks(Structure):
    """`message_type_support_callbacks_t` of rosidl_typesupport_fastrtps_cpp."""

    _fields_ = (
        ("message_namespace", c_char_p),
        ("message_name", c_char_p),
        ("cdr_serialize", c_void_p),
        ("cdr_deserialize", c_void_p),
        ("get_serialized_size", c_void_p),
        ("max_serialized_size", c_void_p),
        ("key_callbacks", c_void_p),
    )


class Member(Structure):
    """`rosidl_typesupport_introspection_c__MessageMember`."""

    _fields_ = (
        ("name", c_char_p),
        ("type_id", c_uint8),
        ("string_upper_bound", c_size_t),
        ("members", c_void_p),
        ("is_key", c_bool),
        ("is_array", c_bool),
        ("array_size", c_size_t),
        ("is_upper_bound", c_bool),
        ("offset", c_uint32),
        ("default_value", c_void_p),
        ("size_function", c_void_p),
        ("get_const_function", c_void_p),
        ("get_function", c_void_p),
        ("fetch_function", c_void_p),
        ("assign_function", c_void_p),
        ("resize_function", c_void_p),
    )


class Members(Structure):
    """`rosidl_typesupport_introspection_c__MessageMembers`."""

    _fields_ = (
        ("message_namespace", c_char_p),
        ("message_name", c_char_p),
        ("member_count", c_uint32),
        ("size_of", c_size_t),
        ("has_any_key_member", c_bool),
        ("members", POINTER(Member)),
        ("init_function", c_void_p),
        ("fini_function", c_void_p),
    )


class ServiceHandle(Structure):
    """`rosidl_service_type_support_t`."""

    _fields_ = (
        ("typesupport_identifier", c_char_p),
        ("data", c_void_p),
        ("func", c_void_p),
        ("request_typesupport", c_void_p),
        ("response_typesupport", c_void_p),
        ("event_typesupport", c_void_p),
        ("event_message_create_handle_function", c_void_p),
        ("event_message_destroy_handle_function", c_void_p),
        ("get_type_hash_func", c_void_p),
        ("get_type_description_func", c_void_p),
        ("get_type_description_sources_func", c_void_p),
    )


class ActionHandle(Structure):
    """`rosidl_action_type_support_t`."""

    _fields_ = (
        ("goal_service_type_support", c_void_p),
        ("result_service_type_support", c_void_p),
        ("cancel_service_type_support", c_void_p),
        ("feedback_message_type_support", c_void_p),
        ("status_message_type_support", c_void_p),
        ("get_type_hash_func", c_void_p),
        ("get_type_description_func", c_void_p),
        ("get_type_description_sources_func", c_void_p),
    )


class ServiceCallbacks(Structure):
    """`service_type_support_callbacks_t` of rosidl_typesupport_fastrtps_cpp."""

    _fields_ = (
        ("service_namespace", c_char_p),
        ("service_name", c_char_p),
        ("request", c_void_p),
        ("response", c_void_p),
    )


class ServiceMembers(Structure):
    """`rosidl_typesupport_introspection_c__ServiceMembers`."""

    _fields_ = (
        ("service_namespace", c_char_p),
        ("service_name", c_char_p),
        ("request", c_void_p),
        ("response", c_void_p),
        ("event", c_void_p),
    )


class FastBuffer(Structure):
    """`eprosima::fastcdr::FastBuffer`: its virtual table, then the memory that it stands for."""

    _fields_ = (("virtual_table", c_void_p), ("bytes", Bytes), ("is_internal", c_bool))


class Cdr(Structure):
    """The head of `eprosima::fastcdr::Cdr`: seven pointers to member functions, then its buffer."""

    _fields_ = (("coders", c_void_p * 14), ("buffer", POINTER(FastBuffer)))


_IMMORTAL: list[object] = []


def immortal(value: _Value) -> _Value:
    """Keep an object for the rest of the process: the middleware never says when it has let go of a type."""
    _IMMORTAL.append(value)
    return value


def address(pointer: Any) -> int:  # noqa: ANN401  # each pointer and function has a class of its own
    """Return where a pointer or function of ctypes points to."""
    return ctypes.cast(pointer, c_void_p).value or 0


def text(value: bytes) -> String:
    """Return a rosidl string over bytes that live as long as the process."""
    return String(address(c_char_p(immortal(value))), len(value), len(value) + 1)


def sequence(kind: type[Structure], items: Sequence[Structure]) -> String:
    """Return a rosidl sequence over copies of the items that live as long as the process."""
    array = immortal((kind * len(items))(*items))
    return String(ctypes.addressof(array), len(items), len(items))
