"""The type support of TFMessage without a compiler.

The middleware calls a message's type support while it holds a lock of the writer or reader, in a thread that
holds the interpreter's lock. Were such a callback to run bytecode, another thread could get the interpreter's
lock there and wait for the middleware's: both would wait for ever. So nothing below runs bytecode: each callback
is a callable written in C (an operator, an `attrgetter`, a method of a dictionary or an iterator) that ends in a
function of a library, called without releasing the interpreter's lock. No interrupt (Ctrl-C) is taken there
either, so none is lost. What does need bytecode happens in `conversion`, before and after.

In Python 3.11 one way is left: an allocation in there can start a garbage collection, and that a finalizer of
the user's. Since 3.12 a collection waits for the next bytecode.

Rejected: calling the compiled serializers of the element from a Python loop (bytecode under a lock, and a C++
exception for malformed data would cross Python's frames); a process-wide lock around publish and take (does not
cover the creation of endpoints); machine code in memory of our own (one version per processor).
"""

from __future__ import annotations

import ctypes
import operator
from contextlib import contextmanager
from ctypes import CFUNCTYPE, POINTER, c_bool, c_char_p, c_int, c_size_t, c_uint32, c_void_p, py_object
from itertools import repeat
from operator import attrgetter
from typing import TYPE_CHECKING, NamedTuple

from orchestra.ros.interfaces import description, layouts
from orchestra.ros.interfaces.layouts import Bytes, Callbacks, Cdr, FastBuffer, Handle

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from orchestra.ros.interfaces.conversion import MessageInTransit

_FAST_CDR = "libfastcdr.so.2"
_RUNTIME = "librosidl_runtime_c.so"
FASTRTPS = b"rosidl_typesupport_fastrtps_c"
INTROSPECTION = b"rosidl_typesupport_introspection_c"
_ROS_TYPE_MESSAGE = 18  # rosidl_typesupport_introspection_c/field_types.h


class UnsupportedInstallationError(ImportError):
    """The installed ROS libraries are not laid out as in ROS 2 Jazzy."""


class _Buffer:
    """Argument converter: what a `Cdr` reads, as pointer and length.

    By value, a structure of these two is passed in two registers, exactly as the two would be.
    """

    from_param = attrgetter("contents.buffer.contents.bytes")


class _Outgoing:
    """Argument converter: what a message sends, as pointer and length."""

    from_param = attrgetter("outgoing")


class Message(NamedTuple):
    """What the middleware is told of a message type.

    `namespace` is that of the C names, `package__msg`. `unbounded` is the `max_serialized_size` of a type without
    bounds: that of any compiled type that has a string will do.
    """

    namespace: bytes
    name: bytes
    description: layouts.TypeDescription
    sources: layouts.String
    members: layouts.Members
    unbounded: int


class Libraries:
    """The libraries behind a type support. Raises `OSError` or `UnsupportedInstallationError`."""

    def __init__(self) -> None:
        self.runtime = ctypes.PyDLL(_RUNTIME)
        self.fast_cdr = ctypes.PyDLL(_FAST_CDR)
        _check_layout(self.fast_cdr)

    def compiled(self, handle: int) -> tuple[Handle, Handle]:
        """Return the two handles, for sending and for introspection, of a compiled type."""
        find = self.runtime.get_message_typesupport_handle
        find.argtypes, find.restype = [c_void_p, c_char_p], POINTER(Handle)
        return find(handle, FASTRTPS).contents, find(handle, INTROSPECTION).contents


def build(element: int, transit: type[MessageInTransit]) -> int:
    """Make the type support of TFMessage from the handle of TransformStamped; return its address.

    `transit` is the class of the objects that stand for messages; it learns to take bytes and to free them.

    Raises:
        UnsupportedInstallationError: the libraries are not those of ROS 2 Jazzy.
    """
    with jazzy("TFMessage", "tf2_msgs"):
        libraries = Libraries()
        fastrtps, introspection = libraries.compiled(element)
        of_element, sources = described(fastrtps)
        member = layouts.Member(
            name=b"transforms",
            type_id=_ROS_TYPE_MESSAGE,
            members=ctypes.addressof(introspection),
            is_array=True,
        )
        message = Message(
            b"tf2_msgs__msg",
            b"TFMessage",
            description.describe(of_element),
            description.sources(sources),
            members(b"tf2_msgs__msg", b"TFMessage", [member]),
            unbounded(fastrtps),
        )
        return message_support(message, transit, libraries)


@contextmanager
def jazzy(what: str, package: str) -> Iterator[None]:
    """Say what to do where the libraries are not those of ROS 2 Jazzy."""
    try:
        yield
    except UnsupportedInstallationError as error:
        raise UnsupportedInstallationError(f"{error}; install {package} to use {what}") from error
    except (OSError, AttributeError, ValueError) as error:  # no such library or function, a null pointer
        raise UnsupportedInstallationError(f"{error}; install {package} to use {what}") from error


def message_support(message: Message, transit: type[MessageInTransit], libraries: Libraries) -> int:
    """Make the type support of a message; return the address of its handle.

    `transit` is the class of the objects that stand for messages; it learns to take bytes and to free them.
    """
    _give_memory(transit, libraries.runtime)
    data = {
        FASTRTPS: _callbacks(message, libraries.fast_cdr),
        INTROSPECTION: message.members,
    }
    return handles(Handle, data, description_functions(message.description, message.sources))[FASTRTPS]


def handles(
    kind: type[ctypes.Structure], data: dict[bytes, ctypes.Structure], functions: list[int], *others: int
) -> dict[bytes, int]:
    """Make a handle for each type support, which lead to each other; `others` come before the description functions."""
    table: dict[bytes, int] = {}
    dispatch = _callback(CFUNCTYPE(c_void_p, _handle_in(table), c_char_p), operator.getitem)
    for identifier, of_it in data.items():
        handle = layouts.immortal(kind(identifier, ctypes.addressof(of_it), dispatch, *others, *functions))
        table[identifier] = ctypes.addressof(handle)
    return table


def _callback(prototype: Callable[..., object], function: Callable[..., object]) -> int:
    return layouts.address(layouts.immortal(prototype(function)))


def _handle_in(table: dict[bytes, int]) -> type[c_void_p]:
    """Return the type of a handle for which `handle[identifier]` is the address of the type support of that name."""
    return type("HandleReference", (c_void_p,), {"__getitem__": table.get})


def _constant(address: int) -> int:
    """Return a C function that returns this address, whatever it is given."""
    return _callback(CFUNCTYPE(c_void_p), repeat(address).__next__)


def described(compiled: Handle) -> tuple[layouts.TypeDescription, layouts.String]:
    """Return the description of a compiled type, and the sequence of its definition files."""
    prototype = ctypes.PYFUNCTYPE(c_void_p, c_void_p)
    return (
        layouts.TypeDescription.from_address(prototype(compiled.get_type_description_func)(None)),
        layouts.String.from_address(prototype(compiled.get_type_description_sources_func)(None)),
    )


def unbounded(compiled: Handle) -> int:
    """Return the function of a type without bounds that says so, and a size to begin with."""
    return int(Callbacks.from_address(compiled.data).max_serialized_size)


def description_functions(of_type: layouts.TypeDescription, sources: layouts.String) -> list[int]:
    """Return the functions of a handle that return the type's hash, description and sources."""
    values = (description.type_hash(of_type), of_type, sources)
    return [_constant(ctypes.addressof(layouts.immortal(value))) for value in values]


def _give_memory(transit: type[MessageInTransit], runtime: ctypes.PyDLL) -> None:
    """Let messages take what comes in, `cdr >> message`, and free it in the end."""
    # By index: each time another object, with types of its own, where an attribute is always the same one.
    receive = runtime["rosidl_runtime_c__String__assignn"]
    receive.restype = c_bool
    receive.argtypes = [POINTER(transit), _Buffer]  # type: ignore[list-item]  # converting is all it takes
    free = runtime["rosidl_runtime_c__String__fini"]
    free.argtypes, free.restype = [POINTER(transit)], None
    transit.__rrshift__ = _method(receive)  # type: ignore[attr-defined]  # a method from a library
    transit.__del__ = _method(free)  # type: ignore[attr-defined]  # as above


def _callbacks(message: Message, fast_cdr: ctypes.PyDLL) -> Callbacks:
    """Return what rmw_fastrtps calls to send, `message >> cdr`, and to receive, `cdr >> message`."""
    cdr = POINTER(Cdr)
    send = fast_cdr._ZN8eprosima7fastcdr3Cdr15serialize_arrayEPKcm  # noqa: SLF001  # a C++ name, not a private one
    send.restype = c_void_p
    send.argtypes = [cdr, _Outgoing]  # type: ignore[list-item]  # converting is all it takes
    cdr.__rrshift__ = _method(send)  # type: ignore[attr-defined]  # a method from a library
    return layouts.immortal(
        Callbacks(
            message.namespace.replace(b"__", b"::"),
            message.name,
            _callback(CFUNCTYPE(c_bool, py_object, cdr), operator.rshift),
            _callback(CFUNCTYPE(c_bool, cdr, py_object), operator.rshift),
            _callback(CFUNCTYPE(c_uint32, py_object), attrgetter("outgoing.size")),
            message.unbounded,
        )
    )


def _method(function: Callable[..., object]) -> object:
    """Return a function that binds to the instance when it is found in a class, as those written in Python do."""
    bind = ctypes.pythonapi.PyInstanceMethod_New
    bind.argtypes, bind.restype = [py_object], py_object
    return bind(function)


def members(namespace: bytes, name: bytes, fields: Sequence[layouts.Member]) -> layouts.Members:
    """Return the names and types of the fields, which the middleware makes its own type object from.

    The functions that reach into a message stay null: a message in transit is serialized.
    """
    array = layouts.immortal((layouts.Member * len(fields))(*fields))
    return layouts.immortal(
        layouts.Members(
            namespace, name, member_count=len(fields), members=ctypes.cast(array, POINTER(layouts.Member))
        )
    )


def _check_layout(fast_cdr: ctypes.PyDLL) -> None:
    """Let the library fill a buffer and a coder and look whether it puts things where `layouts` expects them."""
    memory = ctypes.create_string_buffer(16)
    buffer, cdr = FastBuffer(), ctypes.create_string_buffer(1024)
    make_buffer = fast_cdr._ZN8eprosima7fastcdr10FastBufferC1EPcm  # noqa: SLF001  # a C++ name, not a private one
    make_buffer.argtypes, make_buffer.restype = [c_void_p, c_void_p, c_size_t], None
    make_cdr = fast_cdr._ZN8eprosima7fastcdr3CdrC1ERNS0_10FastBufferENS1_10EndiannessENS0_10CdrVersionE  # noqa: SLF001  # as above
    make_cdr.argtypes, make_cdr.restype = [c_void_p, c_void_p, c_int, c_int], None
    make_buffer(ctypes.addressof(buffer), ctypes.addressof(memory), len(memory))
    make_cdr(ctypes.addressof(cdr), ctypes.addressof(buffer), 1, 1)
    found: Bytes = buffer.bytes
    reference = layouts.address(Cdr.from_buffer(cdr).buffer)
    expected = (ctypes.addressof(memory), len(memory), ctypes.addressof(buffer))
    if (found.data, found.size, reference) != expected:
        raise UnsupportedInstallationError(f"{_FAST_CDR} is laid out in another way than in ROS 2 Jazzy")
