"""The message about an event of a service, which rcl has made and published where introspection is turned on.

rcl calls these functions outside of the middleware, so they may run bytecode.
"""

from __future__ import annotations

import ctypes
from ctypes import (
    CFUNCTYPE,
    POINTER,
    Structure,
    c_bool,
    c_int32,
    c_int64,
    c_uint8,
    c_uint32,
    c_void_p,
    py_object,
)
from typing import TYPE_CHECKING, Any

from orchestra.ros.interfaces import cdr, conversion, layouts

if TYPE_CHECKING:
    from orchestra.ros.interfaces.conversion import MessageInTransit

Class = Any  # a class of a message or service, untyped


class Info(Structure):
    """`rosidl_service_introspection_info_t`."""

    _fields_ = (
        ("event_type", c_uint8),
        ("stamp_sec", c_int32),
        ("stamp_nanosec", c_uint32),
        ("client_gid", c_uint8 * 16),
        ("sequence_number", c_int64),
    )


def functions(service: Class, transit: type[MessageInTransit]) -> tuple[int, int]:
    """Return the functions that make and end the event messages of a service; `transit` stands for those."""

    def create(info: Any, _allocator: object, request: int | None, response: int | None) -> Any:  # noqa: ANN401 - of ctypes
        made = transit()
        event = _about(service, info.contents)
        try:
            event.request = [_message(request, service.Request)] if request else []
            event.response = [_message(response, service.Response)] if response else []
            made.outgoing = conversion.body(cdr.encode(event))
        except Exception:  # noqa: BLE001  # a message may hold anything, and rcl does not live without the event
            conversion.log.exception("an event of %s is told without what was sent", service.__name__)
            made.outgoing = conversion.body(cdr.encode(_about(service, info.contents)))
        return made

    made_by = CFUNCTYPE(py_object, POINTER(Info), c_void_p, c_void_p, c_void_p)(create)
    ended_by = CFUNCTYPE(c_bool, c_void_p, c_void_p)(_end)
    return layouts.address(layouts.immortal(made_by)), layouts.address(layouts.immortal(ended_by))


def _about(service: Class, told: Info) -> Any:  # noqa: ANN401 - a message
    """Return the message about an event, without what was sent."""
    event = service.Event()
    event.info.event_type = told.event_type
    event.info.stamp.sec, event.info.stamp.nanosec = told.stamp_sec, told.stamp_nanosec
    event.info.client_gid = list(told.client_gid)
    event.info.sequence_number = told.sequence_number
    return event


def _message(address: int, kind: Class) -> Any:  # noqa: ANN401 - a message
    """Return the message that is on its way at an address: one that came in, or one that is sent."""
    found: MessageInTransit = ctypes.cast(address, py_object).value
    return found() if found.incoming.size else cdr.decode(found.outgoing.message, kind)


def _end(address: int, _allocator: object) -> bool:
    release = ctypes.pythonapi.Py_DecRef
    release.argtypes, release.restype = [py_object], None
    release(ctypes.cast(address, py_object))
    return True
