"""Messages as values between commas, as `message_to_csv` of rosidl_runtime_py writes them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.ros.tools.messages.fields import fields_of, is_message, is_nested
from orchestra.ros.tools.messages.plain import ELLIPSIS, WHOLE, Shortening, value_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Sized

    from orchestra.ros.tools.messages.fields import Kind


def csv_text(message: Any, short: Shortening = WHOLE) -> str:  # noqa: ANN401 - of any class
    """Return all values of a message in one line, ending with a line break."""
    return _fields(message, short) + "\n"


def _fields(message: Any, short: Shortening) -> str:  # noqa: ANN401 - as above
    return _joined(_value(getattr(message, name), short, kind) for name, kind in fields_of(type(message)))


def _value(value: Any, short: Shortening, kind: Kind = None) -> str:  # noqa: ANN401 - of any type
    if is_message(value):
        return _fields(value, short)
    if isinstance(value, bytes):
        return str(value if _fits(value, short) else value[: short.length] + ELLIPSIS.encode())
    if isinstance(value, str) or (short.no_arrays and is_nested(kind)):
        return str(value_of(value, short, kind))
    if not hasattr(value, "__len__"):
        return str(value)  # numbers, those of numpy too
    shown = [_value(one, short) for one in (value if _fits(value, short) else value[: short.length])]
    return _joined(shown if _fits(value, short) else [*shown, ELLIPSIS])


def _fits(value: Sized, short: Shortening) -> bool:
    return short.length is None or len(value) <= short.length


def _joined(values: Iterable[str]) -> str:
    """Return texts with commas between them; none stands before the first that is not empty."""
    made = ""
    for value in values:
        made += f",{value}" if made else value
    return made
