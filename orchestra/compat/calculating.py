"""Substitutions that do nothing but calculate, as conditions are made of them.

What they come to is found out once for all that are alike but for their numbers, as of those in YAML and XML
(`load.nested`). Their skeleton is written with marks, for not all of them could be read back from a text.
"""

from __future__ import annotations

import re
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.calls import CallSubstitution, Made
from orchestra.compat.launch.substitutions.launch_configuration import LaunchConfiguration
from orchestra.compat.launch.substitutions.text_substitution import TextSubstitution
from orchestra.compat.parsed import ParsedSubstitution
from orchestra.compat.place import argument
from orchestra.compat.text import performs, shown, template
from orchestra.description.calculated import DIGIT, Calculated
from orchestra.description.substitutions import Part, Shape
from orchestra.description.text import (
    matched_template,
    new_call,
    new_template,
    new_words,
)
from orchestra.description.written import called, escaped

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.compat.place import Argument, Place
    from orchestra.description.text import Call, Template
    from orchestra.description.text import Part as TextPart
    from orchestra.location import Span

_DIGITS: Final = re.compile(r"[0-9]+")
# What no text may have in it: where a call begins, and each of its arguments; what is behind the call, and a text.
_BEGIN, _ARGUMENT, _END, _BEHIND = "\x01", "\x02", "\x03", "\x04"
_MARKS: Final = re.compile(r"([\x01-\x04])")
_VARIABLE: Final = f"{_BEGIN}var{_ARGUMENT}"
_BEHIND_VARIABLE: Final = f"{_BEHIND}{_END}"
_LONGEST: Final = 300  # marks included; longer ones are not kept
# Classes, with what performs them, of which it is known that the engine does; and the names of their arguments.
_known: Final[set[tuple[type[Any], Any]]] = set()
_parameters: Final[dict[str, tuple[str, ...]]] = {"var": LaunchConfiguration._parameters}


# Classes of arguments that are kept as they are given.
plain: Final[set[type[Any]]] = {str, TextSubstitution, LaunchConfiguration}


class Calculating(ParsedSubstitution):
    """A substitution whose result depends on nothing but its arguments."""

    # How many arguments are kept as they are given, None: any number of them.
    _count: int | None = 1

    def _keep(self, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> bool:
        if keywords or len(arguments) != (len(arguments) if self._count is None else self._count):
            return False
        given: list[Any] = []
        for items in arguments:
            if type(items) is list:
                if not plain.issuperset(map(type, items)):
                    return False
                given.append(items.copy())
            elif type(items) in plain:
                given.append(items)
            else:
                return False
        self._as_given = tuple(given), keywords
        return True

    def _make(self, given: tuple[tuple[Any, ...], dict[str, Any]]) -> None:
        shown[0] += 1
        super()._make(given)

    def _is_noted(self) -> bool:
        """Return whether it is noted when code is shown what this one was given, or what is in that."""
        given = self._as_given
        return given is not None and all(
            type(item) is str
            or item._known_as is not None
            or (isinstance(item, Calculating) and item._is_noted())
            for items in given[0]
            for item in (items if type(items) is list else (items,))
        )

    def _whole(self) -> Template | None:
        pieces: list[str] = []
        made: list[Any] = []
        if not _is_written(self, pieces, made):
            return super()._whole()
        text = "".join(pieces)
        if len(text) > _LONGEST or not text.isascii():
            return super()._whole()
        numbers = tuple(_DIGITS.findall(text))
        if numbers:
            skeleton = _DIGITS.sub(DIGIT, text)
            raw = _written(skeleton) % numbers
        else:
            skeleton, raw = text, _written(text)
        return matched_template(raw, False, Made(self), 0, _Calculation(text, skeleton, numbers, made))


def _is_written(call: Calculating, pieces: list[str], made: list[Any]) -> bool:
    """Write a call with marks, and what has places; false where that cannot be said of all that it is made of."""
    kind: Any = type(call)
    if (kind, kind.perform) not in _known and not _is_known(kind):
        return False
    pieces += (_BEGIN, call._name)
    made.append(call)
    given = call._as_given
    for items in call._arguments() if given is None else given[0]:
        pieces.append(_ARGUMENT)
        item: Any
        for item in items if type(items) is list else (items,):
            kind = type(item)
            if kind is LaunchConfiguration:
                name = item._alone()
                if name is None or not name.isprintable():
                    return False
                pieces += (_VARIABLE, name, _BEHIND_VARIABLE)
                made.append(item)
            elif kind is str or kind is TextSubstitution:
                text = item if kind is str else item.text
                if not text.isprintable():
                    return False
                pieces += (text, _BEHIND)
            elif not isinstance(item, Calculating) or not _is_written(item, pieces, made):
                return False
    pieces.append(_END)
    return True


def _is_known(kind: Any) -> bool:
    """Return whether no code of launch files says what a substitution comes to, nor how it is written."""
    if (
        kind._parts is not CallSubstitution._parts
        or kind._raw is not CallSubstitution._raw
        or not kind.perform.__module__.startswith("orchestra.compat.")
    ):
        return False
    _known.add((kind, kind.perform))
    performs(kind)
    _parameters[kind._name] = kind._parameters
    return True


class _Calculation(Calculated):
    """What such a substitution is made of, and what was made for it at a place, in order."""

    __slots__ = ("_made",)

    def __init__(self, text: str, skeleton: str, numbers: tuple[str, ...], made: Sequence[Any]) -> None:
        super().__init__(text, skeleton, numbers)
        self._made = made

    @staticmethod
    def shape_of(skeleton: str) -> Shape:
        """Return what a skeleton looks like."""
        return _read(_MARKS.split(skeleton), 0)[0]

    def placed(self, whole: Span) -> tuple[TextPart, ...]:
        """Return the call."""
        del whole
        (call,) = self.shape_of(self.text).parts
        return (_call(call, iter([item._place for item in self._made])),)


@lru_cache(maxsize=256)
def _written(skeleton: str) -> str:
    """Return how a substitution is written, as a format for the numbers where it has any."""
    raw = _Calculation.shape_of(skeleton).raw
    return raw.replace("%", "%%").replace(DIGIT, "%s") if DIGIT in skeleton else raw


def _read(tokens: Sequence[str], at: int) -> tuple[Shape, int]:
    """Return the argument that begins there, or all of it, and what follows behind it."""
    parts: list[Part] = []
    raw = ""
    while at < len(tokens) and tokens[at] not in (_ARGUMENT, _END):
        token = tokens[at]
        at += 1
        if token == _BEGIN:
            name, arguments = tokens[at], []
            at += 1
            while tokens[at] == _ARGUMENT:
                shape, at = _read(tokens, at + 1)
                arguments.append(shape)
            at += 1
            parts.append(Part(name, tuple(arguments), 0, 0))
            raw += called(name, [argument.raw for argument in arguments])
        elif token and token != _BEHIND:
            parts.append(Part(token, None, 0, 0))
            raw += escaped(token)
    return Shape(tuple(parts), raw, 0, 0, False), at


def _call(part: Part, places: Iterator[Place]) -> Call:
    place, names = next(places), _parameters[part.text]
    arguments = [
        _text(shape, argument(place, (names[index] if names else f"*{index}",)), places)
        for index, shape in enumerate(part.arguments or ())
    ]
    return new_call(part.text, tuple(arguments), place.span)


def _text(shape: Shape, at: Argument, places: Iterator[Place]) -> Template:
    """Return an argument, which stands there as far as it has no place of its own."""
    if all(part.arguments is None for part in shape.parts) and len(shape.parts) < _SEVERAL:
        return template("".join([part.text for part in shape.parts]), at)
    parts: list[TextPart] = [
        new_words(part.text, at) if part.arguments is None else _call(part, places) for part in shape.parts
    ]
    return new_template(tuple(parts), shape.raw, parts[0].span if len(parts) == 1 else at)


_SEVERAL: Final = 2
