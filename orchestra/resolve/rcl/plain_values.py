"""Scalars of parameter files of which there is nothing to tell, whatever parameter they are for."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Final

from orchestra.patterns import pattern
from orchestra.resolve.rcl.scalars import SLIPS, typed
from orchestra.resolve.rcl.surprises import surprise

if TYPE_CHECKING:
    from orchestra.values import Scalar

_NUMBER: Final = pattern(r"-?(?:0|[1-9][0-9]{0,14})(?:\.[0-9]{1,15})?")
_NUMERIC: Final = frozenset("+-.0123456789")
_QUOTES: Final = ("'", '"')
_BOOLEANS: Final = {"true": True, "True": True, "false": False, "False": False}
# What a word in any case may mean to somebody beside itself.
_MEANT: Final = frozenset(
    {"y", "yes", "n", "no", "on", "off", "true", "false", "null", "nan", "inf", "infinity", *SLIPS}
)
_SIGNED: Final = ("e-", "e+", "E-", "E+")


class Unlike(Exception):  # noqa: N818 - no fault of anybody
    """It takes a closer look."""


def named_value(written: str, name: str) -> Scalar:
    """Return the value of a scalar for a parameter. Raises `Unlike`, as where a zero at its end may be of a name."""
    value = value_of(written)
    if written[-1] == "0" and isinstance(value, float) and written[-2] != ".":
        from orchestra.resolve.rcl.oddities import is_of_name  # noqa: PLC0415 - few numbers end so

        if is_of_name(name):
            raise Unlike
    return value


def value_of(written: str) -> Scalar:
    """Return the value of a scalar on one line, in quotes without escapes or plain. Raises `Unlike`."""
    if written[0] in _QUOTES:
        text = written[1:-1]
        if _may_have_unit(text):
            raise Unlike
        return text
    value = _read(written)
    if value is None:
        raise Unlike
    return value


@lru_cache(maxsize=1024)
def _read(text: str) -> Scalar | None:
    """Return what a plain scalar is read as, None where it takes a closer look."""
    if _NUMBER.fullmatch(text) is not None:
        return float(text) if "." in text else int(text)
    if text in _BOOLEANS:
        return _BOOLEANS[text]
    if text.isidentifier() and text.isascii() and text.lower() not in _MEANT:
        return text
    value = typed(text)
    if isinstance(value, float):
        plain = text[-1] != "0" if "e" not in text.lower() else any(sign in text for sign in _SIGNED)
    else:
        plain = text[0] != "-" and not _may_have_unit(text)
    return value if plain and surprise(text, value) is None else None


def _may_have_unit(text: str) -> bool:
    return text[:1] in _NUMERIC and not text[-1:].isdigit()
