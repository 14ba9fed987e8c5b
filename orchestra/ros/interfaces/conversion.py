"""Messages on their way between Python and the middleware, and the functions that rclpy asks a class for.

For rclpy a message in transit is a pointer that it gets from one of these functions and hands to the others and
to the middleware. Here the pointer is a reference to a Python object. So the functions that convert to Python and
that destroy are the interpreter's own, which calls and lets go of an object: they report an exception as rclpy
expects it. A function made by ctypes cannot, which matters for the one that converts from Python.
"""

from __future__ import annotations

import _thread
import ctypes
import logging
import signal
import sys
import time
from ctypes import CFUNCTYPE, PYFUNCTYPE, Structure, c_bool, c_char_p, c_void_p, py_object
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from orchestra.ros.interfaces import layouts
from orchestra.ros.interfaces.layouts import Bytes, String

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import FrameType

log = logging.getLogger(__name__)
_LOOK = 0.0005  # seconds between two looks at where a thread is
_AT_MOST = 1.0  # seconds; a thread that computes for longer is interrupted where it is
_WAITS = ("State:", "voluntary_ctxt_switches:")  # proc(5)
_SLEEPS = "S"
_HEADER = 4  # bytes of the encapsulation, which the middleware writes itself

_Result = TypeVar("_Result")


def body(message: bytes) -> Bytes:
    """Return where the body of a serialized message is; the message lives as long as the result."""
    found = Bytes(layouts.address(c_char_p(message)) + _HEADER, len(message) - _HEADER)
    vars(found)["message"] = message
    return found


class MessageInTransit(Structure):
    """A serialized message, between the middleware and Python.

    `incoming` is what the middleware delivered, header included, in memory of rosidl_runtime_c. `outgoing` is the
    body that it is to send: until there is one, that of a message without fields. Calling the object makes
    the Python message of what came in. `typesupport` adds how it is filled and freed. A subclass for each type
    says how it is called and how it is read and written.
    """

    _fields_ = (("incoming", String),)

    type_name = ""
    outgoing = body(bytes(_HEADER + 4))

    def __call__(self) -> object:
        """Return what came in as a message."""
        raise NotImplementedError

    def encode(self, source: Any) -> bytes:  # noqa: ANN401  # whatever is sent
        """Return a message as it goes over the wire, header included. Raises where it cannot be sent."""
        raise NotImplementedError

    def serialized(self) -> bytes:
        """Return what came in, header included."""
        return ctypes.string_at(self.incoming.data, self.incoming.size)


def capsules(transit: type[MessageInTransit]) -> dict[str, object]:
    """Return rclpy's functions as capsules, by the names under which it looks for them on a metaclass."""
    api = ctypes.pythonapi
    return {
        "_CREATE_ROS_MESSAGE": _capsule_of(CFUNCTYPE(py_object)(transit)),
        "_CONVERT_FROM_PY": _capsule_of(PYFUNCTYPE(c_bool, py_object, py_object)(_from_py)),
        "_CONVERT_TO_PY": _capsule_of(api.PyObject_CallNoArgs),
        "_DESTROY_ROS_MESSAGE": _capsule_of(api.Py_DecRef),
    }


def capsule(address: int) -> object:
    """Wrap an address as rclpy takes it."""
    new = ctypes.pythonapi.PyCapsule_New
    new.argtypes, new.restype = [c_void_p, c_char_p, c_void_p], py_object
    return new(address, None, None)


def address_in(pointer: object) -> int:
    """Return the address that a capsule holds."""
    get = ctypes.pythonapi.PyCapsule_GetPointer
    get.argtypes, get.restype = [py_object, c_char_p], c_void_p
    return int(get(pointer, None))


def uninterrupted(convert: Callable[..., _Result], *arguments: object) -> _Result:
    """Call a short function that may be repeated, once more if it is interrupted, and pass the interrupt on.

    rclpy does not expect KeyboardInterrupt from a conversion, and would lose it. Another thread sends the signal
    again when this one has left the function that rclpy has called, and sleeps in a call: to one that comes between it
    and the kernel the call would pay no heed.
    """
    try:
        return convert(*arguments)
    except KeyboardInterrupt:
        result = convert(*arguments)
        called = sys._getframe(1)  # noqa: SLF001 - who calls this one is known in no other way
        _thread.start_new_thread(_interrupt, (_thread.get_ident(), _thread.get_native_id(), called))
        return result


def _interrupt(thread: int, number: int, called: FrameType) -> None:
    until, before, now = time.monotonic() + _AT_MOST, None, _asleep(number)
    # The same sleep, seen twice: one for the interpreter, which this thread had, would have ended in between.
    while time.monotonic() < until and (_is_in(called, thread) or now is None or now != before):
        time.sleep(_LOOK)
        before, now = now, _asleep(number)
    signal.pthread_kill(thread, signal.SIGINT)


def _is_in(called: FrameType, thread: int) -> bool:
    """Tell whether a thread is still in a function."""
    frame = sys._current_frames().get(thread)  # noqa: SLF001 - as above
    while frame is not None and frame is not called:
        frame = frame.f_back
    return frame is not None


def _asleep(number: int) -> str | None:
    """Return which one of its sleeps a thread is in, by its number in the kernel; None where it runs."""
    status = Path(f"/proc/self/task/{number}/status").read_text("utf-8", "replace")
    state, sleep = (next(line for line in status.splitlines() if line.startswith(name)) for name in _WAITS)
    return sleep if state.split()[1] == _SLEEPS else None


def _capsule_of(function: object) -> object:
    return capsule(layouts.address(layouts.immortal(function)))


def _from_py(source: Any, message: MessageInTransit) -> bool:  # noqa: ANN401  # whatever is published
    """Prepare a message for sending; False where it cannot be sent, which rclpy turns into a RuntimeError.

    The reason goes to the log: ctypes has no way to hand the exception on.
    """
    try:
        uninterrupted(_prepare, source, message)
    except Exception:  # any field may be of any class; all is told below
        log.exception("this %s cannot be sent", message.type_name)
        return False
    return True


def _prepare(source: Any, message: MessageInTransit) -> None:  # noqa: ANN401  # as above
    message.outgoing = body(message.encode(source))
