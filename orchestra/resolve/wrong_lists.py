"""What is wrong with a list of values: the whole of it, or the one item that is of another type than the others."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.description.text import Template
from orchestra.resolve.rcl.mixed import in_place, odd_item, wanted_type
from orchestra.resolve.scalars import coerced, upstream_value

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.fields import Value as Typed
    from orchestra.location import Span
    from orchestra.values import ParameterValue, Scalar

_WORDS = {bool: "bool", int: "int", float: "float", str: "str"}


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
