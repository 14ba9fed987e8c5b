"""From messages to plain data: mappings in the order of the definition, lists, numbers and texts.

What it gives is what `message_to_ordereddict` of rosidl_runtime_py gives, which no wheel has.
"""

from __future__ import annotations

from array import array
from typing import Any

from orchestra.dataclass import dataclass
from orchestra.ros.tools.messages.fields import Kind, fields_of, is_message, is_nested, name_of

ELLIPSIS = "..."


@dataclass(frozen=True, slots=True)
class Shortening:
    """How much of a message is shown: `length` of arrays and texts, None for all; arrays and texts at all."""

    length: int | None = None
    no_arrays: bool = False
    no_texts: bool = False


WHOLE = Shortening()


def plain(message: Any, short: Shortening = WHOLE) -> dict[str, Any]:  # noqa: ANN401 - of any class
    """Return a message as plain data."""
    return {name: value_of(getattr(message, name), short, kind) for name, kind in fields_of(type(message))}


def value_of(value: Any, short: Shortening = WHOLE, kind: Kind = None) -> Any:  # noqa: ANN401 - of any type
    """Return the value of a field as plain data; `kind` is its type where it is known."""
    if isinstance(value, bool | int | float):
        return value
    if isinstance(value, bytes):
        return _shortened("".join(map(chr, value)), short.length)
    if isinstance(value, str):
        return f"<string length: <{len(value)}>>" if short.no_texts else _shortened(value, short.length)
    if is_message(value):
        return plain(value, short)
    if short.no_arrays and is_nested(kind):
        return _instead(value, kind)
    return _items(value, short)


def _items(value: Any, short: Shortening) -> list[Any]:  # noqa: ANN401 - lists, arrays of Python and of numpy
    cut = short.length is not None and len(value) > short.length
    shown = value[: short.length] if cut else value
    is_array = isinstance(shown, array) or hasattr(shown, "dtype")
    items = shown.tolist() if is_array else [value_of(item, short) for item in shown]
    return [*items, ELLIPSIS] if cut else items


def _shortened(text: str, length: int | None) -> str:
    return text if length is None or len(text) <= length else text[:length] + ELLIPSIS


def _instead(value: Any, kind: Kind) -> str:  # noqa: ANN401 - as above
    """Return what stands for an array that is left out."""
    name = name_of(kind.value_type)
    if not kind.has_maximum_size():
        return f"<sequence type: {name}, length: {len(value)}>"
    if hasattr(kind, "size"):
        return f"<array type: {name}[{kind.size}]>"
    return f"<sequence type: {name}[{kind.maximum_size}], length: {len(value)}>"
