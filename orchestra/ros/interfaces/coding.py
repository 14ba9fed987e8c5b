"""How the messages of a class are written and read: worked out once for each class, field by field.

Primitives next to each other go in one call of `struct`, which needs to know at which of eight phases they begin:
padding depends on it. The fields of a message are read and set as the slots behind its properties, which check and
convert what a person assigns; what comes in is of the right type already.
"""

from __future__ import annotations

import os
import struct
from functools import cache
from itertools import groupby
from operator import attrgetter
from typing import TYPE_CHECKING, Any, Protocol

from rosidl_parser.definition import AbstractNestedType, BasicType, NamespacedType

from orchestra.ros.interfaces.coding_values import CODES, Value, value_of
from orchestra.ros.interfaces.slots import class_of, fields_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

_CHECK_FIELDS = os.environ.get("ROS_PYTHON_CHECK_FIELDS") == "1"
_PHASES = 8
_EMPTY = b"\0"  # what a message without fields is on the wire


class Step(Protocol):
    """Writes some of the fields of a message, and reads them."""

    def write(self, body: bytearray, message: Any) -> None:  # noqa: ANN401 - a message class, untyped
        """Append the fields."""

    def read(self, data: bytes, at: int, order: str, message: Any) -> int:  # noqa: ANN401 - as above
        """Set the fields; return where they end."""


class Coder:
    """Writes and reads the messages of a class."""

    def __init__(self, kind: Any) -> None:  # noqa: ANN401 - as above
        self._kind = kind
        fields = [(f"_{name}", type_) for name, type_ in fields_of(kind)]
        self._steps: list[Step] = list(_steps(fields))

    def write(self, body: bytearray, message: Any) -> None:  # noqa: ANN401 - as above
        """Append a message."""
        if not isinstance(message, self._kind):
            raise TypeError(f"{message!r} is no {self._kind.__name__}")
        for step in self._steps:
            step.write(body, message)
        if not self._steps:
            body += _EMPTY

    def read(self, data: bytes, at: int, order: str) -> tuple[Any, int]:
        """Return the message that begins at a place, and where it ends."""
        message = self._kind.__new__(self._kind)
        message._check_fields = _CHECK_FIELDS  # noqa: SLF001 - a slot of every message
        for step in self._steps:
            at = step.read(data, at, order, message)
        return message, at + (0 if self._steps else len(_EMPTY))


@cache
def coder(kind: Any) -> Coder:  # noqa: ANN401 - as above
    """Return what writes and reads the messages of a class."""
    return Coder(kind)


def _steps(fields: Sequence[tuple[str, Any]]) -> Iterator[Step]:
    for is_run, some in groupby(fields, lambda field: _is_plain(field[1])):
        if is_run:
            yield _Run(list(some))
        else:
            yield from (_Field(name, _value(kind)) for name, kind in some)


def _is_plain(kind: Any) -> bool:  # noqa: ANN401 - a type of rosidl_parser
    return isinstance(kind, BasicType) and kind.typename in CODES


def _value(kind: Any) -> Value:  # noqa: ANN401 - as above
    if isinstance(kind, NamespacedType):
        return _Nested(kind)
    if isinstance(kind, AbstractNestedType):
        return value_of(kind, _value(kind.value_type))
    return value_of(kind)


class _Nested:
    """A message in a message; its class is looked for when there is one to write or read."""

    def __init__(self, name: NamespacedType) -> None:
        self._name = name
        self._coder: Coder | None = None

    def _found(self) -> Coder:
        if self._coder is None:
            self._coder = coder(class_of(self._name))
        return self._coder

    def write(self, body: bytearray, value: Any) -> None:  # noqa: ANN401 - as above
        self._found().write(body, value)

    def read(self, data: bytes, at: int, order: str) -> tuple[Any, int]:
        return self._found().read(data, at, order)


class _Field:
    """One field."""

    def __init__(self, slot: str, value: Value) -> None:
        self._slot = slot
        self._value = value

    def write(self, body: bytearray, message: Any) -> None:  # noqa: ANN401 - as above
        self._value.write(body, getattr(message, self._slot))

    def read(self, data: bytes, at: int, order: str, message: Any) -> int:  # noqa: ANN401 - as above
        value, at = self._value.read(data, at, order)
        setattr(message, self._slot, value)
        return at


class _Run:
    """Primitives next to each other."""

    def __init__(self, fields: Sequence[tuple[str, Any]]) -> None:
        self._slots = [name for name, _ in fields]
        codes = [CODES[kind.typename] for _, kind in fields]
        layouts = [_padded(codes, phase) for phase in range(_PHASES)]
        self._writers = [struct.Struct(f"={layout}").pack for layout in layouts]
        self._readers = {order: [struct.Struct(order + layout) for layout in layouts] for order in ("<", ">")}
        self._values: Callable[[Any], tuple[Any, ...]] = attrgetter(*self._slots)
        if len(fields) == 1:  # of one name, `attrgetter` returns no tuple
            (only,) = self._slots
            self._values = lambda message: (getattr(message, only),)

    def write(self, body: bytearray, message: Any) -> None:  # noqa: ANN401 - as above
        body += self._writers[len(body) % _PHASES](*self._values(message))

    def read(self, data: bytes, at: int, order: str, message: Any) -> int:  # noqa: ANN401 - as above
        layout = self._readers[order][at % _PHASES]
        for slot, value in zip(self._slots, layout.unpack_from(data, at), strict=True):
            setattr(message, slot, value)
        return at + layout.size


def _padded(codes: Sequence[str], phase: int) -> str:
    """Return the layout of primitives that begin so many bytes after a multiple of eight."""
    layout, at = "", phase
    for code in codes:
        size = struct.calcsize(f"={code}")
        padding = -at % size
        layout += f"{padding}x{code}" if padding else code
        at += padding + size
    return layout
