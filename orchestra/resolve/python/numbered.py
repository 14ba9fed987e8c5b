"""Python files that are alike but for numbers: what short looks tell of one of them is so of the others.

What looks ask of a text is which words and signs stand where, and which words are the same; a number is one to them
whatever its digits are. So where each number of a text is another one in the other text, the same for the same, and
instructions and names are those of the other code, the looks tell the same.
"""

from __future__ import annotations

from types import CodeType
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Collection

    from orchestra.compat.looks import Compiled

_DIGITS: Final = b"0123456789"
_AS_ZERO: Final = bytes.maketrans(_DIGITS, b"0" * 10)
_ALONE: Final = bytes(byte if byte in _DIGITS else 0x20 for byte in range(256))
_MOST: Final = 64


class Told:
    """What looks have told of files, by their texts between numbers; all texts have the `fixed` numbers besides."""

    def __init__(self, fixed: Collection[bytes] = ()) -> None:
        self._fixed = sorted(fixed)
        self._known: dict[object, dict[str, bool]] = {}
        self._alone: dict[
            object, Compiled | None
        ] = {}  # files by what else looks ask; None where there are several

    def add(self, compiled: Compiled) -> None:
        """Have a file share what looks tell of it with those that are alike, by now and later on."""
        asked = asked_of(compiled.code)
        if asked not in self._alone:
            if len(self._alone) >= _MOST:
                del self._alone[next(iter(self._alone))]
            self._alone[asked] = compiled
            return
        first, self._alone[asked] = self._alone[asked], None
        for alike in (compiled,) if first is None else (first, compiled):
            self.share(alike, alike.source, asked)

    def share(self, compiled: Compiled, text: bytes, asked: object) -> None:
        """Have a file share what looks tell of it, by a text and whatever else they ask."""
        key = _skeleton(text), _which_are_same([*self._fixed, *text.translate(_ALONE).split()]), asked
        told = self._known.get(key)
        if told is None:
            if len(self._known) >= _MOST:
                del self._known[next(iter(self._known))]
            self._known[key] = compiled.told
        else:
            told.update(compiled.told)
            compiled.told = told


def _which_are_same(numbers: list[bytes]) -> tuple[int, ...]:
    """Return for each number the place of the first one that is the same."""
    return tuple(map(dict[bytes, int]().setdefault, numbers, range(len(numbers))))


def numbers_of(text: str) -> set[bytes]:
    """Return the numbers in a text."""
    return set(text.encode().translate(_ALONE).split())


def _skeleton(source: bytes) -> bytes:
    """Return a text with 0 for each number; an expression would take five times as long."""
    key = source.translate(_AS_ZERO)
    key = key.replace(b"000", b"0")  # as most are that have several digits
    while b"00" in key:
        key = key.replace(b"00", b"0")
    return key


def asked_of(code: CodeType) -> tuple[Any, ...]:
    """Return the instructions and names of a code, and of those in it."""
    inner = [asked_of(item) for item in code.co_consts if type(item) is CodeType]
    return code.co_code, code.co_names, *inner


TOLD: Final = Told()
