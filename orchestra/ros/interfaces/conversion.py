"""Between TFMessage objects and what the middleware sends: the functions that rclpy asks a class for.

rclpy calls these outside the middleware, so they may run bytecode; they may not raise, since ctypes cannot hand
an exception to the C++ that called. A message that cannot be converted is logged with its traceback, and rclpy
raises an error of its own (RuntimeError or SystemError).
"""

from __future__ import annotations

import _thread
import ctypes
import logging
from ctypes import PYFUNCTYPE, c_bool, c_char_p, c_void_p, py_object
from typing import TYPE_CHECKING, Any

from orchestra.ros.interfaces import layouts, wire
from orchestra.ros.interfaces.layouts import SerializedMessage

if TYPE_CHECKING:
    from collections.abc import Callable

_log = logging.getLogger(__name__)
_HEADER = 4  # bytes of the encapsulation; the middleware writes its own

# Every message between create and destroy, by address: the middleware's pointer is no reference to Python.
_alive: dict[int, SerializedMessage] = {}


def capsules(
    new_message: Callable[[list[Any]], Any], new_transform: Callable[[], Any], finish_string: Any
) -> dict[str, object]:
    """The four functions as capsules, by the names under which rclpy looks for them on a metaclass."""

    def to_py(address: int) -> int:
        return _new_reference(new_message(wire.decode(_serialized(_alive[address]), new_transform)))

    def destroy(address: int) -> None:
        message = _alive.pop(address)
        if message.incoming.data:
            finish_string(ctypes.byref(message.incoming))

    return {
        "_CREATE_ROS_MESSAGE": _function(PYFUNCTYPE(c_void_p), _create),
        "_CONVERT_FROM_PY": _function(PYFUNCTYPE(c_bool, py_object, c_void_p), _guarded(_from_py)),
        "_CONVERT_TO_PY": _function(PYFUNCTYPE(c_void_p, c_void_p), _guarded(to_py)),
        "_DESTROY_ROS_MESSAGE": _function(PYFUNCTYPE(None, c_void_p), destroy),
    }


def capsule(address: int) -> object:
    """A pointer as rclpy takes it."""
    new = ctypes.pythonapi.PyCapsule_New
    new.argtypes, new.restype = [c_void_p, c_char_p, c_void_p], py_object
    return new(address, None, None)


def _function(prototype: Any, function: Callable[..., Any]) -> object:
    address = ctypes.cast(layouts.immortal(prototype(function)), c_void_p).value
    assert address is not None
    return capsule(address)


def _guarded(convert: Callable[..., int]) -> Callable[..., int]:
    """Turn whatever is raised into a zero, which tells rclpy of the failure, and a record in the log."""

    def guarded(*arguments: Any) -> int:
        try:
            return convert(*arguments)
        except KeyboardInterrupt:
            _thread.interrupt_main()  # once more, where it can be raised
        except Exception:
            _log.exception("a TFMessage cannot be converted")
        return 0

    return guarded


def _create() -> int:
    message = SerializedMessage()
    address = ctypes.addressof(message)
    _alive[address] = message
    return address


def _from_py(source: Any, address: int) -> int:
    message = _alive[address]
    message.payload = payload = wire.encode(source.transforms)  # held as long as there is a pointer to it
    start = ctypes.cast(c_char_p(payload), c_void_p).value or 0
    message.outgoing.data, message.outgoing.size = start + _HEADER, len(payload) - _HEADER
    return 1


def _serialized(message: SerializedMessage) -> bytes:
    if message.incoming.data:
        return ctypes.string_at(message.incoming.data, message.incoming.size)
    return getattr(message, "payload", wire.EMPTY)


def _new_reference(value: object) -> int:
    increase = ctypes.pythonapi.Py_IncRef
    increase.argtypes, increase.restype = [py_object], None
    increase(value)
    return id(value)


def address_in(pointer: object) -> int:
    """The address that a capsule holds."""
    get = ctypes.pythonapi.PyCapsule_GetPointer
    get.argtypes, get.restype = [py_object, c_char_p], c_void_p
    address = get(pointer, None)
    assert isinstance(address, int)
    return address
