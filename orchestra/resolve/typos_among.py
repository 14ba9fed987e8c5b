"""The names among many that a word may be mistyped for, found without a long look at each: see `is_typo`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from orchestra.resolve.typos import is_typo

if TYPE_CHECKING:
    from collections.abc import Iterable

_WRONG: Final = 2  # letters that may be wrong, of each of which two names have one that the other may lack
_BITS: Final = 63
_NO_LETTERS: Final = str.maketrans("", "", "_-")


class _Known(NamedTuple):
    name: str
    letters: int
    length: int


class Names:
    """Names to look among: those with the digits of a word, nearly its length and nearly its letters are looked at."""

    def __init__(self, names: Iterable[str]) -> None:
        self._by_digits: dict[str, list[_Known]] = {}
        for name in names:
            self._by_digits.setdefault(_digits(name), []).append(_known(name))

    def meant_by(self, word: str) -> list[str]:
        """Return the names that a word is hardly anything but mistyped for."""
        _, letters, length = _known(word)
        least, most = length - _WRONG, length + _WRONG
        near = [
            known.name
            for known in self._by_digits.get(_digits(word), ())
            if least <= known.length <= most and (known.letters ^ letters).bit_count() <= _WRONG * 2
        ]
        return [name for name in near if is_typo(word, name)]


def _known(name: str) -> _Known:
    """Return a name with a bit for each kind of letter in it; lines do not count, of which it may have any number."""
    bare = name.lower().translate(_NO_LETTERS)
    letters = 0
    for letter in set(bare):
        letters |= 1 << (ord(letter) % _BITS)
    return _Known(name, letters, len(bare))


def _digits(text: str) -> str:
    return "".join(filter(str.isdigit, text))
