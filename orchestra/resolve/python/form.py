"""What files that are alike have in common: a text with slots, and the code that is made of what stands in those."""

from __future__ import annotations

from itertools import repeat
from operator import contains, itemgetter
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.looks import Compiled
from orchestra.resolve.python.form_codes import Classes, CodeForm, Columns, is_same
from orchestra.resolve.python.form_slots import QUOTES, Name, Sum, is_sum, sum_of
from orchestra.resolve.python.form_texts import FormText, taking
from orchestra.resolve.python.numbered import Told, numbers_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from types import CodeType

_ASKING_NO_TEXT: Final = ("harmless", "tuples")  # looks at names and instructions, and at kinds of constants


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
        own, numbers = self._number(parts, places)
        self._text = FormText(parts, places, numbers)
        values = self._text.values("".join(others))
        if values is None or self._text.values("".join(parts)) != own:
            raise ValueError(
                "slots are not where they seemed to be, or what is equal in one text is not in the other"
            )
        self._taken = taken
        keys, other_keys = self._keys(own), self._keys(values)
        if keys is None or other_keys is None:
            raise ValueError("a value is not written plainly")
        self._columns = Columns(parts, [index for index, before in places.items() if before is not None])
        self._each = taking([number for number in numbers if number < len(own)])
        self._widths = tuple(map(len, own))
        self._moved: tuple[tuple[int, ...], list[int] | None] = self._widths, None
        classes = Classes(keys, other_keys)
        self._code = CodeForm(compiled.code, other.code, classes, self._columns)
        classes.check()
        self._taken |= self._code.fixed
        self._knows_moves = True
        made = self._made(other.code.co_filename, values, other_keys)
        if made is None or not self._taken.isdisjoint(keys) or not is_same(made, other.code):
            raise ValueError("the compiler makes something else")
        self._knows_moves = self._moved[1] is not None
        self._told = Told(numbers_of(self._text.fixed))
        self._told.share(other, "\n".join(values).encode(), None)

    def _number(
        self, parts: Sequence[str], places: Mapping[int, str | None]
    ) -> tuple[tuple[str, ...], list[int]]:
        """Number the values, those of one kind after the other; return them, and the number of each slot."""
        named = [_named(parts[2 * index + 1], before, index) for index, before in places.items()]
        order = sorted(dict.fromkeys(named), key=lambda value: _ORDER[value[0]])
        numbers = {value: number for number, value in enumerate(order)}
        kinds = [kind for kind, _, _ in order]
        self._texts = kinds.count(str)
        self._floats = self._texts + kinds.count(int)
        self._others_begin = self._floats + kinds.count(float)
        own = [value for value in order if value[0] is not None]
        self._others = [(kind, before) for kind, before, _ in own[self._others_begin :]]
        return tuple(value for _, _, value in own), [numbers[value] for value in named]

    def _keys(self, values: tuple[str, ...]) -> list[Any] | None:
        """Return the values that differ, a number with its type; None where others do than in the form."""
        keys: list[Any] = [*values[: self._texts]]
        written = "".join(keys)
        if "\\" in written or "\n" in written:
            return None
        numbers = _numbers(values[self._texts : self._floats], values[self._floats : self._others_begin])
        if numbers is None:
            return None
        keys += numbers
        for (kind, before), value in zip(self._others, values[self._others_begin :], strict=True):
            key = sum_of(value) if kind is Sum else _name_of(before + value, value)
            if key is None:
                return None
            keys.append(key)
        known = set(keys)
        return keys if len(known) == len(keys) and self._taken.isdisjoint(known) else None

    def compiled(self, path: str, source: bytes, text: str) -> Compiled | None:
        """Return the code of a text, as of a file at a path; None where the form says nothing of it."""
        values = self._text.values(text)
        keys = None if values is None else self._keys(values)
        if values is None or keys is None:
            return None
        code = self._made(path, values, keys)
        if code is None:
            return None
        known = self._first.told
        made = Compiled(code, source, {look: known[look] for look in _ASKING_NO_TEXT if look in known})
        self._told.share(made, "\n".join(values).encode(), None)
        return made

    def _made(self, path: str, values: Sequence[str], keys: Sequence[Any]) -> CodeType | None:
        widths = tuple(map(len, values))
        if widths != self._moved[0]:
            self._moved = widths, self._columns.shifts(self._each(widths), self._each(self._widths))
        shifts = self._moved[1]
        if shifts is not None and not self._knows_moves:
            return None
        return self._code.made(path, [*keys[: self._texts], *map(_VALUE, keys[self._texts :])], shifts)


_ORDER: Final = {str: 0, int: 1, float: 2, Sum: 3, Name: 4, None: 5}
_VALUE: Final = itemgetter(1)
# Of such signs nothing but numbers are put together that the compiler reads as `float` does.
_OF_FLOATS: Final = b"0123456789.-"


def _named(literal: str, before: str | None, index: int) -> tuple[type[Any] | None, str, Any]:
    """Return what kind of value a literal is, what stands before it, and how it is written; comments by their index."""
    if before is None:
        return None, "", index
    if before:
        return Name, before, literal
    if literal[0] in QUOTES:
        return str, "", literal[1:-1]
    if is_sum(literal):
        return Sum, "", literal
    return (float if "." in literal else int), "", literal


def _numbers(whole: tuple[str, ...], others: tuple[str, ...]) -> list[tuple[type[Any], Any]] | None:
    """Return the values of numbers with their types; None where one is written in another way than it is shown."""
    if not all(map(contains, others, repeat("."))):
        return None
    try:
        ints, floats = list(map(int, whole)), list(map(float, others))
    except ValueError:
        return None
    if tuple(map(repr, ints)) != whole:
        return None
    if "".join(others).encode().translate(None, _OF_FLOATS) and tuple(map(repr, floats)) != others:
        return None
    return [*zip(repeat(int), ints), *zip(repeat(float), floats)]


def _name_of(name: str, end: str) -> tuple[type[Any], str] | None:
    return (Name, name) if end.isdigit() else None
