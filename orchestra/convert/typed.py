"""Values of parameters: what type they get where they stand, and how a value is written so that it gets its type."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from orchestra.convert.texts import normal
from orchestra.description.text import Constant, Template
from orchestra.pyyaml import yaml
from orchestra.resolve.rcl.overrides import override_value
from orchestra.resolve.scalars import checked, coerced, unified, upstream_value

if TYPE_CHECKING:
    from orchestra.values import ParameterValue, Scalar

    Typed: TypeAlias = Template | Constant
    Given: TypeAlias = Typed | tuple[Typed, ...]


def type_word(template: Template | None) -> str | None:
    """Return the type that a value is given, None where it is read by its looks."""
    word = None if template is None else template.constant
    return None if word == "yaml" else word


def value_of(given: Given, word: str | None, *, quotes: bool) -> ParameterValue | None:
    """Return the value that a node gets; None where substitutions decide, or where it can have no type.

    `quotes`: whether a text in quotes is one, whatever it looks like, as it is not where all nodes are set.
    """
    try:
        if isinstance(given, tuple):
            return _list(given, word)
        if isinstance(given, Constant):
            value = checked(given.value, word)
            return value if quotes or word is not None else retyped(value)
        return _text(given, word, quotes=quotes)
    except ValueError:
        return None


def retyped(value: ParameterValue) -> ParameterValue:
    """Return what becomes of a text of Python that is set for all nodes (`resolve.parameters`)."""
    if not isinstance(value, str):
        return value
    try:
        other = override_value(value)
    except ValueError:
        return value
    return value if other is None else other


def meaning(given: Given, word: str | None, *, quotes: bool) -> object:
    """Return what a value means, to compare it."""
    value = value_of(given, word, quotes=quotes)
    if value is not None:
        return ("value", repr(value))
    if given == ():
        return ("text", word, ("[]",))
    if isinstance(given, tuple):
        return ("list", word, tuple(meaning(item, _element(word), quotes=True) for item in given))
    return ("text", word, normal(given)) if isinstance(given, Template) else ("faulty", repr(given.value))


def looks(value: Scalar) -> str | None:
    """Return a text that is read by its looks as a value, None where only quotes of the format can say it."""
    text = str(value).lower() if isinstance(value, bool) else str(value)
    if isinstance(value, float):
        text = {"inf": ".inf", "-inf": "-.inf", "nan": ".nan"}.get(repr(value), repr(value))
    return text if _reads_as(text, value) else None


def in_quotes(value: str) -> str:
    """Return a text that is read as a text by its own quotes, as attributes of XML need."""
    single = "'" + value.replace("'", "''") + "'"
    if _reads_as(single, value):
        return single
    dumped: str = yaml.safe_dump(value, default_style='"', allow_unicode=True, width=float("inf"))
    return dumped.removesuffix("\n")


def flow(values: tuple[Scalar, ...]) -> str | None:
    """Return a list as one text that is read as the list, None where there is none."""
    items = [looks(value) for value in values]
    shown = [
        in_quotes(value) if isinstance(value, str) and (text is None or set(text) & set(",[]{}")) else text
        for text, value in zip(items, values, strict=True)
    ]
    if None in shown:
        return None
    text = f"[{', '.join(map(str, shown))}]"
    return text if _reads_as(text, values) else None


def _reads_as(text: str, value: object) -> bool:
    try:
        return repr(upstream_value(text)) == repr(value)
    except ValueError:
        return False


def _text(template: Template, word: str | None, *, quotes: bool) -> ParameterValue | None:
    constant = template.constant
    if constant is None:
        return None
    if word is not None:
        return coerced(constant, word)
    return constant if template.quoted and quotes else upstream_value(constant)


def _list(items: tuple[Typed, ...], word: str | None) -> ParameterValue | None:
    element = _element(word)
    if word is not None and element == word:
        return None
    values = [value_of(item, element, quotes=True) for item in items]
    texts = [item.constant or "" for item in items if isinstance(item, Template)]
    found = [value for value in values if value is not None]
    return unified(found, texts) if found and len(found) == len(values) else None


def _element(word: str | None) -> str | None:
    return None if word is None else word.removeprefix("list_of_")
