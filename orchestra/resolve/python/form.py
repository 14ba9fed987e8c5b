"""What files that are alike have in common: a text with slots, and the code that is made of what stands in those."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.looks import Compiled
from orchestra.resolve.python.form_codes import Classes, CodeForm, Columns, is_same
from orchestra.resolve.python.form_slots import QUOTES, Name, Sum, is_sum, number_of, sum_of
from orchestra.resolve.python.numbered import Told, numbers_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from types import CodeType

_ASKING_NO_TEXT: Final = ("harmless", "tuples")  # looks at names and instructions, and at kinds of constants
_CODING: Final = "coding"  # how a file is written, as a comment may say


class Form:
    """The text and the code that files have in common."""

    def __init__(
        self,
        first: tuple[list[str], Compiled],
        second: tuple[list[str], Compiled],
        places: Mapping[int, str | None],
        taken: set[Any],
    ) -> None:
        """Learn the form of two texts that were split, with their codes, which are alike but at places.

        These are the numbers of literals and of ends of names, with what stands before those, or None for comments;
        `taken` are values that may stand nowhere else. Raises `ValueError` where there is no form.
        """
        (parts, compiled), (others, other) = first, second
        self._first = compiled
        self._slots, self._end = _slots(parts, places)
        self._befores = [before for before in places.values() if before is not None]
        self._comments = [number for number, before in enumerate(places.values()) if before is None]
        own, values = self._values("".join(parts)), self._values("".join(others))
        if own is None or values is None:
            raise ValueError("slots are not where they seemed to be")
        self._kinds = [
            _kind(parts[2 * index + 1], before) for index, before in places.items() if before is not None
        ]
        self._number(own)
        self._taken = taken
        keys, other_keys = self._keys(own), self._keys(values)
        if keys is None or other_keys is None:
            raise ValueError("what is equal in one text is not in the other one")
        self._columns = Columns(parts, [index for index, before in places.items() if before is not None])
        self._widths = list(map(len, own))
        self._moved: tuple[list[int], list[int] | None] = self._widths, None
        classes = Classes(keys, other_keys)
        self._code = CodeForm(compiled.code, other.code, classes, self._columns)
        classes.check()
        self._taken |= self._code.fixed
        self._knows_moves = True
        made = self._made(other.code.co_filename, values, other_keys)
        if made is None or not self._taken.isdisjoint(keys) or not is_same(made, other.code):
            raise ValueError("the compiler makes something else")
        self._knows_moves = self._moved[1] is not None
        self._told = Told(numbers_of("\n".join(piece for piece, _, _ in self._slots) + self._end))
        self._told.share(other, self._differing(values), None)

    def _number(self, own: Sequence[str]) -> None:
        """Number the values that differ, those of one kind after the other."""
        named = list(zip(self._kinds, self._befores, own, strict=True))
        order = sorted(dict.fromkeys(named), key=lambda value: _ORDER[value[0]])
        numbers = {value: number for number, value in enumerate(order)}
        self._pattern = [numbers[value] for value in named]
        self._firsts = [named.index(value) for value in order]
        self._others = [(kind, before) for kind, before, _ in order if kind is not str]
        self._texts = len(order) - len(self._others)

    def _values(self, text: str) -> list[str] | None:
        """Return what stands in the slots of a text; None where the rest of it is another one."""
        found: list[str] = []
        at = 0
        for piece, size, stop in self._slots:
            if not text.startswith(piece, at):
                return None
            at += size
            end = text.find(stop, at)
            if end < 0:
                return None
            found.append(text[at:end])
            at = end
        if text[at:] != self._end:
            return None
        for number in reversed(self._comments):
            if _CODING in found[number] or "\n" in found[number]:
                return None
            del found[number]
        return found

    def _keys(self, values: Sequence[str]) -> list[Any] | None:
        """Return the values that differ, a number with its type; None where others do than in the form."""
        own = [values[place] for place in self._firsts]
        if [own[number] for number in self._pattern] != values:
            return None
        keys: list[Any] = own[: self._texts]
        written = "".join(keys)
        if "\\" in written or "\n" in written:
            return None
        for (kind, before), value in zip(self._others, own[self._texts :], strict=True):
            if kind is Sum:
                key = sum_of(value)
            else:
                key = (Name, before + value) if kind is Name and value.isdigit() else number_of(value)
            if key is None or (key[0] is not kind and kind is not Sum):
                return None
            keys.append(key)
        known = set(keys)
        return keys if len(known) == len(keys) and self._taken.isdisjoint(known) else None

    def compiled(self, path: str, source: bytes, text: str) -> Compiled | None:
        """Return the code of a text, as of a file at a path; None where the form says nothing of it."""
        values = self._values(text)
        keys = None if values is None else self._keys(values)
        if values is None or keys is None:
            return None
        code = self._made(path, values, keys)
        if code is None:
            return None
        known = self._first.told
        made = Compiled(code, source, {look: known[look] for look in _ASKING_NO_TEXT if look in known})
        self._told.share(made, self._differing(values), None)
        return made

    def _made(self, path: str, values: Sequence[str], keys: Sequence[Any]) -> CodeType | None:
        widths = list(map(len, values))
        if widths != self._moved[0]:
            self._moved = widths, self._columns.shifts(widths, self._widths)
        shifts = self._moved[1]
        if shifts is not None and not self._knows_moves:
            return None
        return self._code.made(path, [key if type(key) is str else key[1] for key in keys], shifts)

    def _differing(self, values: Sequence[str]) -> bytes:
        return "\n".join([values[place] for place in self._firsts]).encode()


_ORDER: Final = {str: 0, int: 1, float: 2, Sum: 3, Name: 4}


def _kind(literal: str, before: str) -> type[Any]:
    if before:
        return Name
    if literal[0] in QUOTES:
        return str
    if is_sum(literal):
        return Sum
    return float if "." in literal else int


def _slots(parts: Sequence[str], places: Mapping[int, str | None]) -> tuple[list[tuple[str, int, str]], str]:
    """Return what stands before each slot, how long that is, and what the slot ends with; and the end of the text."""
    found: list[tuple[str, int, str]] = []
    fixed = ""
    last = 0
    for index, before in places.items():
        literal = parts[2 * index + 1]
        fixed += "".join(parts[last : 2 * index + 1])
        last = 2 * index + 2
        if before is None:
            piece, stop, fixed = fixed + literal[0], "\n", ""
        elif literal[0] in QUOTES:
            piece, stop, fixed = fixed + literal[0], literal[0], literal[0]
        else:
            piece, stop, fixed = fixed, parts[last][0], ""
        found.append((piece, len(piece), stop))
    return found, fixed + "".join(parts[last:])
