"""What is wrong with a list of values: the whole of it, or the one item that is of another type than the others."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.description.text import Template, Words
from orchestra.location import Span
from orchestra.pyyaml import yaml
from orchestra.resolve.rcl.mixed import in_place, odd_item, wanted_type
from orchestra.resolve.rcl.scalars import typed
from orchestra.resolve.refusals import forget_surprise
from orchestra.resolve.scalars import coerced, unified, upstream_value

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.fields import Value as Typed
    from orchestra.resolve.resolution import Resolution
    from orchestra.values import ParameterValue, Scalar

_LISTS: Final = "list_of_"
_QUOTES: Final = ("'", '"')
_WORDS = {bool: "bool", int: "int", float: "float", str: "str"}


def united(
    items: Sequence[Typed], values: Sequence[ParameterValue], texts: Sequence[str], run: Resolution
) -> ParameterValue:
    """Return one list of values, as `unified` does; nothing is surprising about them where all stay texts."""
    made = unified(values, texts)
    if made == tuple(texts):
        for item, value in zip(items, values, strict=True):
            if isinstance(item, Template) and not isinstance(value, str):
                forget_surprise(run.place(item).span, run.problems)
    return made


def wrong_as_a_whole(items: Sequence[Typed], element: str) -> str | None:
    """Return what is said of a list whose items are all of one type that is not the one asked for.

    None for any other list: then it is one of its items that is told. `element` is the type asked for.
    """
    kinds, fits = set(), True
    for item in items:
        constant = item.constant if isinstance(item, Template) else None
        if constant is None:
            return None
        try:
            kinds.add(str if item.quoted else type(upstream_value(constant)))  # type: ignore[union-attr] # a template
        except ValueError:
            return None
        fits = fits and _fits(constant, element)
    kind = _WORDS.get(kinds.pop()) if len(kinds) == 1 else None
    if fits or kind in (None, element) or len(items) == 1:
        return None
    return f"this is a list_of_{kind}, not a list_of_{element}"


def _fits(text: str, element: str) -> bool:
    try:
        coerced(text, element)
    except ValueError:
        return False
    return True


def odd_place(items: Sequence[Typed], values: Sequence[ParameterValue]) -> tuple[Span, str | None] | None:
    """Return the place of the item that is of another type than the others, and how it was to be written.

    None where no single one can be told.
    """
    scalars: list[Scalar] = [value for value in values if not isinstance(value, tuple)]
    odd = odd_item(scalars) if len(scalars) == len(items) else None
    if odd is None:
        return None
    item = items[odd]
    text = item.constant if isinstance(item, Template) else None
    if text is None:
        return item.span, None
    return item.span, in_place(text, wanted_type(scalars, odd), quoted=item.quoted)  # type: ignore[union-attr] # a template


def odd_in_text(written: Template, type_word: str | None) -> tuple[Span, str | None] | None:
    """Return the place of the item that is of another type than the others of a list that one text holds, as `[1, a]`.

    With it how it was to be written, where that is known. None where no single one can be told, or where the text does
    not stand in the file as it reads.
    """
    words = written.parts[0] if len(written.parts) == 1 else None
    if not isinstance(words, Words) or not words.text.lstrip().startswith("["):
        return None
    span = words.span
    if span.line != span.end_line or span.end_column - span.column != len(words.text):
        return None
    items, instead = _plain_items(words.text), None
    if type_word is not None and type_word.startswith(_LISTS):
        element = type_word.removeprefix(_LISTS)
        wrong = [at for at, (text, _) in enumerate(items) if not _fits(text, element)]
        odd = wrong[0] if wrong and len(wrong) < len(items) else None
    else:
        scalars = [_of_item(text) for text, _ in items]
        odd = odd_item(scalars)
        instead = None if odd is None else _instead(items[odd][0], wanted_type(scalars, odd))
    if odd is None:
        return None
    begin, end = items[odd][1]
    return Span(span.file, span.line, span.column + begin, span.line, span.column + end), instead


def _of_item(text: str) -> Scalar:
    return text[1:-1] if text[:1] in _QUOTES else typed(text)


def _instead(text: str, wanted: type) -> str | None:
    if text[:1] in _QUOTES:
        return in_place(text[1:-1], wanted, quoted=True)
    return in_place(text, wanted, quoted=False, quote="'")


def meant_as_text(text: str) -> str | None:
    """Return what a text that is no value was meant as: a list with its end, else the text in quotes."""
    if text.startswith("[") and "]" not in text:
        try:
            upstream_value(f"{text.rstrip(', ')}]")
        except ValueError:
            pass
        else:
            return f"{text.rstrip(', ')}]"
    return None if "'" in text or not text.strip("[]{} ") else f"'{text}'"


def _plain_items(text: str) -> list[tuple[str, tuple[int, int]]]:
    """Return the items of a flat list with their offsets; quotes are part of an item. None of any other list."""
    items: list[tuple[str, tuple[int, int]]] = []
    try:
        events = list(yaml.parse(text, Loader=yaml.SafeLoader))[3:-3]
    except yaml.YAMLError:
        return []
    for event in events:
        if not isinstance(event, yaml.ScalarEvent) or event.start_mark is None or event.end_mark is None:
            return []
        begin, end = event.start_mark.index, event.end_mark.index
        items.append((event.value if not event.style else text[begin:end], (begin, end)))
    return items
