"""What the field of a model holds, told by its type: so a value is written and compared as what it is."""

from __future__ import annotations

from enum import Enum, auto
from functools import cache
from typing import TYPE_CHECKING, Annotated, Any, Final, get_args, get_origin

from orchestra.description.fields import AnyValue, Argv, Flag, Literal, Text
from orchestra.description.short import Short

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.description.entity import Entity


class Kind(Enum):
    """What a text in a field is."""

    TEXT = auto()  # any text
    LITERAL = auto()  # any text, without substitutions
    FLAG = auto()  # true or false
    ARGV = auto()  # words of a command
    VALUE = auto()  # a value of any type
    WORD = auto()  # a number, or one of a few words


# A prefix is split when its substitutions are known: it stays a text, or a list.
_TEXTS: Final = frozenset({"launch_prefix"})
_MARKS: Final = {
    Text: Kind.TEXT,
    Literal: Kind.LITERAL,
    Flag: Kind.FLAG,
    Argv: Kind.ARGV,
    AnyValue: Kind.VALUE,
}


@cache
def kind_of(model: type[Entity], field: str) -> Kind:
    """Return what a text in a field is."""
    if field in _TEXTS:
        return Kind.TEXT
    marks = list(_metadata(model, field))
    for alias, kind in _MARKS.items():
        if any(mark is get_args(alias)[1] for mark in marks):
            return kind
    return Kind.WORD


@cache
def short_key(model: type[Entity], field: str) -> str | None:
    """Return the key whose value may stand for the whole part in a field, None where there is no short form."""
    return next((mark.key for mark in _metadata(model, field) if isinstance(mark, Short)), None)


@cache
def key_of(model: type[Entity], field: str) -> str:
    """Return how a field is spelled in launch files."""
    alias: str | None = model.model_fields[field].alias
    return alias or _SPELLED.get(field, field)


# Upstream has a dash in this one.
_SPELLED: Final = {"launch_prefix": "launch-prefix"}


def _metadata(model: type[Entity], field: str) -> Iterator[Any]:
    yield from _annotated(model.model_fields[field].annotation)


def _annotated(annotation: Any) -> Iterator[Any]:  # noqa: ANN401 - a part of a description, whatever it is
    if get_origin(annotation) is Annotated:
        yield from annotation.__metadata__
    for inner in get_args(annotation):
        yield from _annotated(inner)
