"""The types of the models' fields: texts with substitutions, and texts that must come to something narrower.

A value may always be written as a substitution, so each field holds a `Template`; what can be checked without
evaluating (a constant) is checked when the file is read.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Protocol, TypeAlias

from orchestra.description.core import PydanticCustomError, ValidationError
from orchestra.description.marks import Plain, Told
from orchestra.description.source import Listed, Written, kind_of
from orchestra.description.text import Constant, Items, Template, Words
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from pydantic_core.core_schema import ValidationInfo

TRUE_WORDS = frozenset({"true", "1", "yes", "on"})
FALSE_WORDS = frozenset({"false", "0", "no", "off"})
# What is suggested for what is no flag.
FLAG_WORDS = ("true", "false", "yes", "no", "on", "off")
_FLAGS_ELSEWHERE = {
    **dict.fromkeys(("always", "enable", "enabled", "on-failure", "t", "unless-stopped", "y"), "true"),
    **dict.fromkeys(("disable", "disabled", "f", "n", "never", "none"), "false"),
}

# The kind of a fault that is one of a key, not of what stands behind it.
STRAY_KEY = "stray_key"

_SUBSTITUTION = {"type": "string", "pattern": r"\$\("}
_TEXT = {"type": ["string", "number", "boolean"]}
_TEXT_OR_LIST = {"anyOf": [_TEXT, {"type": "array", "items": _TEXT}]}

Value: TypeAlias = Template | Constant


def _any_case(word: str) -> str:
    """Return a regular expression for a word in capitals or not: JSON Schema has no flag for that."""
    return "".join(f"[{letter.upper()}{letter}]" if letter.isalpha() else letter for letter in word)


class TextReader(Protocol):
    """The part of a loader that knows the substitution grammar."""

    def template(self, written: Written) -> Template:
        """Read a text with substitutions."""

    def literal(self, written: Written) -> str:
        """Read a text without substitutions: escapes are taken away."""


def _text(value: object, info: ValidationInfo) -> Template:
    if isinstance(value, Template):
        return value
    reader = info.context or _reader(info)
    if not isinstance(value, Written) or value.null:
        raise _no_scalar(value, "text")
    template: Template = reader.template(value)
    return template


def _literal(value: object, info: ValidationInfo) -> Template:
    if isinstance(value, Template):
        return value
    written = _scalar(value, "text")
    words = Words(_reader(info).literal(written), written.span)
    return Template((words,), written.text, written.span, quoted=written.quoted)


def _reader(info: ValidationInfo) -> TextReader:
    reader: TextReader | None = info.context
    if reader is None:
        raise TypeError("texts are read with a loader as the validation context")
    return reader


def _scalar(value: object, wanted: str) -> Written:
    if not isinstance(value, Written) or value.null:
        raise _no_scalar(value, wanted)
    return value


def _no_scalar(value: object, wanted: str) -> PydanticCustomError:
    facts = {"wanted": wanted, "found": kind_of(value)}
    return PydanticCustomError("wrong_type", "expected {wanted}, found {found}", facts)


def constant_of(
    wanted: str,
    accepts: Callable[[str], bool],
    words: tuple[str, ...] = (),
    elsewhere: Mapping[str, str] = MappingProxyType({}),
    meant: Callable[[str], str | None] | None = None,
) -> Callable[[object, ValidationInfo], Template]:
    """Return a validator of texts that checks constants; `wanted` says to people what is accepted.

    Of the `words` the nearest is suggested; `elsewhere` are those that mean one of them in other languages. `meant`
    finds out what else may be suggested.
    """

    def validate(value: object, info: ValidationInfo) -> Template:
        if not isinstance(value, Template):
            _scalar(value, wanted)
        template = _text(value, info)
        constant = template.constant
        if constant is not None and not accepts(constant):
            near = elsewhere.get(constant.lower()) or nearest(constant, words)
            near = meant(constant) if near is None and meant is not None else near
            near = _without_stray(constant, accepts) if near is None else near
            facts = {"wanted": wanted, "found": f"'{constant}'", "suggestion": near}
            raise PydanticCustomError("wrong_type", "expected {wanted}, found {found}", facts)
        return template

    return validate


def _without_stray(text: str, accepts: Callable[[str], bool]) -> str | None:
    """Return a text without the comma or the like of other languages behind it, where that is accepted."""
    bare = text.strip().rstrip(",;").rstrip()
    return bare if bare != text and accepts(bare) else None


def _is_flag(text: str) -> bool:
    return text.strip().lower() in TRUE_WORDS | FALSE_WORDS


def _is_duration(text: str) -> bool:
    try:
        number = float(text)
    except ValueError:
        return False
    return math.isfinite(number) and number >= 0


def _is_integer(text: str) -> bool:
    try:
        int(text)
    except ValueError:
        return False
    return True


def meant_seconds(text: str) -> str | None:
    """Return the number of seconds that is meant by a text that is none."""
    # Here, because most numbers are some.
    from orchestra.description.numbers_meant import seconds_meant  # noqa: PLC0415

    return seconds_meant(text)


def meant_whole(text: str) -> str | None:
    """Return the whole number that is meant by a text that is none."""
    # Here, because most numbers are some.
    from orchestra.description.numbers_meant import whole_meant  # noqa: PLC0415

    return whole_meant(text)


def _any_value(value: object, info: ValidationInfo) -> Value | tuple[Value, ...]:
    if isinstance(value, tuple | Constant):
        return value
    return text_or_list(value, info)


def text_or_list(value: object, info: ValidationInfo) -> Template | tuple[Template, ...]:
    """Read a text, or a list of texts."""
    if isinstance(value, tuple):
        return value
    if isinstance(value, list):
        items = items_of(value, _text, info)
        return Items(items, value.span) if isinstance(value, Listed) else items
    return _text(value, info)


def items_of(
    values: Iterable[object], read: Callable[[object, ValidationInfo], Template], info: ValidationInfo
) -> tuple[Template, ...]:
    """Read the items of a list; a fault is one of the item, not of the list."""
    return tuple(_item(index, item, read, info) for index, item in enumerate(values))


def _item(
    index: int, value: object, read: Callable[[object, ValidationInfo], Template], info: ValidationInfo
) -> Template:
    try:
        return read(value, info)
    except PydanticCustomError as error:
        raise placed_in((index,), error, value) from None


def placed_in(place: tuple[int | str, ...], error: PydanticCustomError, value: object) -> ValidationError:
    """Return a fault of a part of a value: of the item or the key at the end of a way into it."""
    return ValidationError.from_exception_data("part", [{"type": error, "loc": place, "input": value}])


Text: TypeAlias = Annotated[Template, Plain(_text), Told(_TEXT)]
Literal: TypeAlias = Annotated[Template, Plain(_literal), Told(_TEXT)]
Flag: TypeAlias = Annotated[
    Template,
    Plain(constant_of("true or false", _is_flag, FLAG_WORDS, elsewhere=_FLAGS_ELSEWHERE)),
    Told(
        {
            "type": ["boolean", "integer", "string"],
            "minimum": 0,
            "maximum": 1,
            "pattern": rf"\$\(|^\s*({'|'.join(map(_any_case, sorted(TRUE_WORDS | FALSE_WORDS)))})\s*$",
            "patternErrorMessage": "expected true or false",
        }
    ),
]
Seconds: TypeAlias = Annotated[
    Template,
    Plain(constant_of("a number of seconds", _is_duration, meant=meant_seconds)),
    Told({"anyOf": [{"type": "number", "minimum": 0}, {"type": "string", "pattern": r"\$\(|^[0-9.eE+-]+$"}]}),
]
Integer: TypeAlias = Annotated[
    Template,
    Plain(constant_of("a whole number", _is_integer, meant=meant_whole)),
    Told({"anyOf": [{"type": "integer"}, {"type": "string", "pattern": r"\$\(|^[+-]?[0-9]+$"}]}),
]
AnyValue: TypeAlias = Annotated[Value | tuple[Value, ...], Plain(_any_value), Told(_TEXT_OR_LIST)]
# Words of a command: a text that is split as a shell would, or a list of which each item is exactly one word.
Argv: TypeAlias = Annotated[Template | tuple[Template, ...], Plain(text_or_list), Told(_TEXT_OR_LIST)]


def worded(*words: str) -> Told:
    """Return what an editor is told of a field for one of a few words."""
    return Told({"anyOf": [{"enum": list(words)}, _SUBSTITUTION]})


def word(
    *words: str, elsewhere: Mapping[str, str] = MappingProxyType({})
) -> Callable[[object, ValidationInfo], Template]:
    """Return a validator for one of a few words; `elsewhere` are those that mean one of them in other languages."""
    wanted = f"one of {', '.join(words)}" if len(words) > 1 else f"'{words[0]}'"
    return constant_of(wanted, lambda text: text in words, words, elsewhere)
