"""The types of the installed packages, made a second time of their definitions, and values for their fields."""

from __future__ import annotations

import sys
from array import array
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from rosidl_parser.definition import AbstractGenericString, AbstractNestedType, Array, NamespacedType

from orchestra.ros.interfaces.made.classes import classes_of
from orchestra.ros.interfaces.made.values import is_compact, numpy_array
from orchestra.ros.interfaces.reading import interface
from orchestra.ros.interfaces.slots import TYPE_CODES, class_of, fields_of

if TYPE_CHECKING:
    from collections.abc import Iterator
    from random import Random

_INTEGERS = {f"{sign}int{bits}": (sign, bits) for sign in ("", "u") for bits in (8, 16, 32, 64)}


class Pair(NamedTuple):
    """A class made here, and the compiled one; `kind` is `msg` or `srv`."""

    name: str
    made: Any
    compiled: Any
    kind: str


@cache
def pairs() -> tuple[Pair, ...]:
    """Return all types of the installed packages."""
    return tuple(_pairs())


def messages() -> list[Pair]:
    """Return the messages, those of services included."""
    return [pair for pair in pairs() if pair.kind == "msg"]


def _pairs() -> Iterator[Pair]:
    for path in sorted(Path(sys.prefix, "share").glob("*/*/*")):
        package, kind = path.parts[-3], path.parts[-2]
        if path.suffix != f".{kind}" or kind not in ("msg", "srv"):
            continue
        compiled = getattr(import_module(f"{package}.{kind}"), path.stem)
        made = classes_of(interface.read(package, path), compiled.__module__)[path.stem]
        yield Pair(f"{package}/{kind}/{path.stem}", made, compiled, kind)
        for part in ("Request", "Response", "Event") if kind == "srv" else ():
            name = f"{package}/{kind}/{path.stem}_{part}"
            yield Pair(name, getattr(made, part), getattr(compiled, part), "msg")


def filled(kind: Any, random: Random, depth: int = 0) -> Any:
    """Return a message with something in each field."""
    return kind(**{name: value(of_field, random, depth) for name, of_field in fields_of(kind)})


def value(kind: Any, random: Random, depth: int = 0) -> Any:
    """Return a value that a field can hold, as it holds it."""
    if not isinstance(kind, AbstractNestedType):
        return _single(kind, random, depth)
    most = min(2 if depth < 3 else 0, getattr(kind, "maximum_size", 2))
    size = kind.size if isinstance(kind, Array) else random.randint(0, most)
    items = [_single(kind.value_type, random, depth) for _ in range(size)]
    if not is_compact(kind):
        return items
    return (
        numpy_array(kind, items)
        if isinstance(kind, Array)
        else array(TYPE_CODES[kind.value_type.typename], items)
    )


def _single(kind: Any, random: Random, depth: int) -> Any:
    if isinstance(kind, NamespacedType):
        return filled(class_of(kind), random, depth + 1)
    if isinstance(kind, AbstractGenericString):
        return random.choice(["", "a", "frame", "wörld", "a longer text"])
    if kind.typename in _INTEGERS:
        sign, bits = _INTEGERS[kind.typename]
        return random.randrange(2**bits) - (0 if sign else 2 ** (bits - 1))
    if kind.typename == "boolean":
        return random.random() < 0.5
    if kind.typename == "octet":
        return bytes([random.randrange(256)])
    return random.choice([0.0, -0.5, 1e10, 2.0**-20])
