"""Values of parameters as expressions of Python: typed already where they are known, else objects."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from orchestra.convert.python.code import Atom, Bracket, Element, a_list, call, string
from orchestra.convert.remarks import UnsayableError
from orchestra.convert.typed import retyped, type_word, value_of
from orchestra.description.text import Constant, Template

if TYPE_CHECKING:
    from orchestra.convert.python.code import Code
    from orchestra.convert.python.texts import Texts
    from orchestra.convert.typed import Given
    from orchestra.values import Scalar


def number(text: str) -> Atom | None:
    """Return the literal of a number or a truth value that is written as this text again, None for other texts."""
    word = {"true": "True", "false": "False"}.get(text)
    if word is not None:
        return Atom(word)
    for kind in (int, float):
        try:
            value = kind(text)
        except ValueError:
            continue
        return Atom(text) if repr(value) == text and math.isfinite(value) else None
    return None


def value(given: Given, type_of: Template | None, texts: Texts, *, quotes: bool) -> Code:
    """Return the expression for a value. Raises `UnsayableError`.

    Without `quotes` it is set for all nodes, where a text is read by its looks.
    """
    word = type_word(type_of)
    if type_of is not None and type_of.constant is None:
        raise UnsayableError("in Python the type of a value is known beforehand", type_of.span)
    known = value_of(given, word, quotes=quotes)
    if known is not None:
        typed = tuple(map(_literal, known)) if isinstance(known, tuple) else _literal(known)
        if not quotes and isinstance(known, str) and retyped(known) != known:
            return _with_type(typed, "str", texts)
        return a_list(typed) if isinstance(typed, tuple) else typed
    if isinstance(given, tuple):
        element = None if word is None else word.removeprefix("list_of_")
        items = a_list(_item(item, element, texts) for item in given)
        return items if word is None else _with_type(items, word, texts)
    if isinstance(given, Constant):
        return _faulty(given)
    if given.constant is None:
        return texts.of(given) if word is None else _with_type(texts.of(given), word, texts)
    looked_at = a_list([texts.substitution(given)])
    return looked_at if word is None else _with_type(looked_at, word, texts)


def _item(item: Template | Constant, element: str | None, texts: Texts) -> Code:
    """Return an item of a list in which substitutions stand: each that is read by its looks is a list itself."""
    known = value_of(item, element, quotes=True)
    if isinstance(known, str) or (element is not None and isinstance(known, bool | int | float)):
        return _literal(known)
    if isinstance(item, Constant):
        return _faulty(item)
    code = texts.of(item)
    return code if isinstance(code, Bracket) and code.start == "[" else a_list([code])


def _literal(known: Scalar) -> Atom:
    if isinstance(known, str):
        return string(known)
    if isinstance(known, float) and not math.isfinite(known):
        return Atom(f'float("{known}")')
    return Atom(repr(known))


def _faulty(given: Constant) -> Code:
    raise UnsayableError(f"no parameter can have the value {given.value!r}", given.span)


def _with_type(code: Code | tuple[Atom, ...], word: str, texts: Texts) -> Code:
    kind, _, items = word.partition("list_of_")
    if items:
        kind = f"{texts.name('List')}[{items}]"
    inner = a_list(code) if isinstance(code, tuple) else code
    return call(texts.name("ParameterValue"), [Element(inner), Element(Atom(kind), "value_type=")])
