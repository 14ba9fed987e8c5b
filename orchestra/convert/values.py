"""Values of parameters as nodes of YAML and XML: each so that it gets the type again that it had."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.convert.plain import is_plain
from orchestra.convert.remarks import UnsayableError
from orchestra.convert.texts import written
from orchestra.convert.tree import Item, Scalar, Sequence, Style
from orchestra.convert.typed import flow, in_quotes, looks, value_of
from orchestra.description.text import Constant, Template
from orchestra.description.written import escaped

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.convert.tree import Node
    from orchestra.convert.typed import Given, Typed
    from orchestra.location import Span
    from orchestra.values import ParameterValue

    Build = Callable[[Given, str | None, bool], Node]


def in_yaml(given: Given, word: str | None, *, quotes: bool) -> Node:
    """Return a value for YAML, where quotes make a text; `word` is the type that it is given.

    Without `quotes` those of YAML make no text: it has to bring its own. Raises `UnsayableError`.
    """
    if isinstance(given, tuple):
        return Sequence(tuple(Item(in_yaml(item, _element(word), quotes=True)) for item in given))
    if isinstance(given, Template):
        text = written(given)
        if given.constant is None or word is not None:
            return Scalar(text, Style.TEXT, given.span)
        if given.quoted:
            return Scalar(text, Style.QUOTED, given.span)
        if is_plain(text):
            return Scalar(text, Style.PLAIN, given.span)
    value = value_of(given, word, quotes=quotes)
    return _constant(value, given, quotes=quotes)


def _constant(value: ParameterValue | None, given: Typed, *, quotes: bool) -> Node:
    if value is None:
        if isinstance(given, Template) and not quotes:  # it is as faulty in quotes
            return Scalar(written(given), Style.QUOTED, given.span)
        shown = given.constant if isinstance(given, Template) else repr(given.value)
        raise UnsayableError(f"no parameter can have the value {shown}", given.span)
    if isinstance(value, tuple):
        items = (_constant(item, Constant(item, given.span), quotes=True) for item in value)
        return Sequence(tuple(map(Item, items)))
    text = looks(value)
    if text is not None and is_plain(escaped(text)):
        return Scalar(escaped(text), Style.PLAIN, given.span)
    if not isinstance(value, str):
        raise UnsayableError(f"no parameter can have the value {value!r}", given.span)
    return Scalar(escaped(value if quotes else in_quotes(value)), Style.QUOTED, given.span)


def in_xml(given: Given, word: str | None, *, quotes: bool) -> Node:
    """Return a value for XML, where a text that looks like something else has quotes of its own.

    Raises `UnsayableError`.
    """
    value = value_of(given, word, quotes=quotes)
    if isinstance(value, tuple) and word is None:
        text = flow(value)
        if text is not None:
            return Scalar(escaped(text), Style.TEXT, _place(given))
    if isinstance(given, tuple):
        return Sequence(tuple(Item(in_xml(item, _element(word), quotes=True)) for item in given))
    if isinstance(given, Template) and (
        given.constant is None or word is not None or not given.quoted or not quotes
    ):
        return Scalar(written(given), Style.TEXT, given.span)
    if isinstance(given, Constant) and word is not None and isinstance(given.value, str):
        return Scalar(escaped(given.value), Style.TEXT, given.span)
    found = value if value is not None and not isinstance(value, tuple) else _scalar(given)
    shown = looks(found)
    if shown is None and isinstance(found, str):
        shown = in_quotes(found)
    if shown is None:
        raise UnsayableError(f"no parameter can have the value {found!r}", given.span)
    return Scalar(escaped(shown), Style.TEXT, given.span)


def _scalar(given: Typed) -> bool | int | float | str:
    if isinstance(given, Template):
        return given.constant or ""
    if isinstance(given.value, tuple):
        raise UnsayableError(f"no parameter can have the value {given.value!r}", given.span)
    return given.value


def _place(given: Given) -> Span:
    return given[0].span if isinstance(given, tuple) else given.span


def _element(word: str | None) -> str | None:
    return None if word is None else word.removeprefix("list_of_")
