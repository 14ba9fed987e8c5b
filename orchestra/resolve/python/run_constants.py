"""Constants of a code, as the compiler numbers them."""

from __future__ import annotations

from itertools import repeat
from opcode import EXTENDED_ARG, hasconst
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

CONSTANTS: Final = frozenset(hasconst)  # operations with one
_PLAIN: Final = frozenset({str, int, float, bool, type(None)})


class Numbers:
    """The constants of a code by the order in which they are used first."""

    def __init__(self, consts: Sequence[Any], used: Sequence[int]) -> None:
        """Take constants of which some have been used."""
        self.consts = list(consts[: max(used, default=0) + 1])
        self._known = {key_of(constant): number for number, constant in enumerate(self.consts)}
        if len(self._known) != len(self.consts):
            raise ValueError("a constant is there twice")

    def loads(self, operations: Sequence[int], constants: Sequence[Any]) -> list[bytes]:
        """Return the instructions for some constants."""
        known, found = self._known, []
        for operation, constant in zip(operations, constants, strict=True):
            key = constant if type(constant) is str else key_of(constant)
            number = known.get(key)
            if number is None:
                number = known[key] = len(self.consts)
                self.consts.append(constant)
            if number < 1 << 8:
                found.append(bytes((operation, number)))
            else:  # `bytes` raises `ValueError` for what is too much
                found.append(bytes((EXTENDED_ARG, number >> 8, operation, number & 0xFF)))
        return found


def key_of(constant: Any) -> Any:
    """Return what tells a constant from others, as the compiler does."""
    kind = type(constant)
    if kind is str:
        return constant
    if kind is tuple:
        return (tuple, *map(key_of, constant))
    if kind is float and constant == 0:
        return kind, repr(constant)
    return kind, constant if kind in _PLAIN else id(constant)


def as_written(constant: Any) -> Any:
    """Return a text or number as literals are known by."""
    return constant if type(constant) is str else (type(constant), constant)


def leaves_of(constant: Any) -> Iterator[Any]:
    """Yield the texts and numbers in a constant. Raises `ValueError` for what is not told apart by its value."""
    if type(constant) is tuple:
        for item in constant:
            yield from leaves_of(item)
    elif type(constant) not in _PLAIN:
        raise ValueError("another constant")
    elif constant is not None and constant is not True and constant is not False:
        yield constant


def built(constant: Any, columns: Iterator[Any]) -> Any:
    """Return the values of a constant, one by one, by those of the texts and numbers in it."""
    if type(constant) is tuple:
        return zip(*[built(item, columns) for item in constant], strict=False)
    return repeat(constant) if constant is None or type(constant) is bool else next(columns)
