"""The type that rcl's C parser gives to a plain scalar: a word for a boolean, what `strtol` or `strtod` read whole.

Source: `rcl_yaml_param_parser`, `get_value`; C17 7.22.1; measured in `tests/data/rcl-probes.jsonl`.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.values import Scalar

_TRUE = frozenset(["Y", "y", "yes", "Yes", "YES", "true", "True", "TRUE", "on", "On", "ON"])
_FALSE = frozenset(["N", "n", "no", "No", "NO", "false", "False", "FALSE", "off", "Off", "OFF"])
# Slips of `true` and `false`: letters swapped, doubled or left out, as far as that makes no other word.
SLIPS = {
    **dict.fromkeys(("ture", "treu", "ttrue", "trrue", "truue", "truee", "tru"), "true"),
    **dict.fromkeys(("flase", "fasle", "fales", "flse", "fals"), "false"),
    **dict.fromkeys(("ffalse", "faalse", "fallse", "falsse", "falsee"), "false"),
}
_YAML_FLOATS = {
    f"{sign}.{word}": float(f"{sign}{word}") for sign in ("", "+", "-") for word in ("inf", "Inf", "INF")
} | {f".{word}": float(word) for word in ("nan", "NaN", "NAN")}

_SPACES = " \t\n\v\f\r"
_INTEGERS = range(-(2**63), 2**63)
_INTEGER = pattern(r"([-+]?)(?:0[xX]([0-9a-fA-F]+)|0([0-7]*)|([1-9][0-9]*))")
_DECIMAL = pattern(r"[-+]?(?P<digits>[0-9]++\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?")
_HEXADECIMAL = pattern(
    r"[-+]?0[xX](?=\.?[0-9a-fA-F])(?P<digits>(?P<whole>[0-9a-fA-F]*+)\.?(?P<part>[0-9a-fA-F]*))(?:[pP](?P<power>[-+]?[0-9]+))?"
)
_SPECIAL = pattern(r"([-+]?)(inf(?:inity)?|nan)(?:(?<=nan)\([0-9A-Za-z_]*\))?", re.IGNORECASE)
_LEAST_NORMAL = 2.0**-1022


def typed(text: str) -> Scalar:
    """Return the value of a plain (or block) scalar: boolean, integer of 64 bits, double or, failing all, the text."""
    if text in _TRUE or text in _FALSE:
        return text in _TRUE
    number = text.lstrip(_SPACES)
    integer = _integer(number)
    if integer is not None:
        return integer
    double = _YAML_FLOATS.get(text, _double(number))
    return text if double is None else double


def _integer(text: str) -> int | None:
    """Read like `strtol` with base 0; None where it stops early or leaves the range."""
    found = _INTEGER.fullmatch(text)
    if found is None:
        return None
    sign, hexadecimal, octal, decimal = found.groups()
    digits, base = (hexadecimal, 16) if hexadecimal else (decimal, 10) if decimal else (octal or "0", 8)
    if len(digits) > 64:  # noqa: PLR2004 - longer than any number of 64 bits in base 8, zeros in front aside
        digits = digits.lstrip("0")[:64] or "0"
    value = int(sign + digits, base)
    return value if value in _INTEGERS else None


def _double(text: str) -> float | None:
    """Read like `strtod`; None where it stops early or reports a range error."""
    if special := _SPECIAL.fullmatch(text):
        return float(special[1] + special[2])
    if decimal := _DECIMAL.fullmatch(text):
        value = float(text)
        return value if _in_range(value, decimal, lambda: _is(text, value)) else None
    if hexadecimal := _HEXADECIMAL.fullmatch(text):
        try:
            value = float.fromhex(text)
        except OverflowError:
            return None
        return (
            value
            if _in_range(value, hexadecimal, lambda: _is_hexadecimal(text, hexadecimal, value))
            else None
        )
    return None


def _in_range(value: float, found: re.Match[str], is_exact: Callable[[], bool]) -> bool:
    """Return whether `strtod` is content: no overflow, and nothing lost where numbers become subnormal."""
    size = abs(value)
    if size == float("inf"):
        return False
    if size == 0:
        return not re.search("[1-9a-fA-F]", found["digits"])
    return size >= _LEAST_NORMAL or is_exact()


def _is(text: str, value: float) -> bool:
    from decimal import Decimal  # noqa: PLC0415 - slow, and few numbers are as small as that

    return Decimal(text) == Decimal(value)


def _is_hexadecimal(text: str, found: re.Match[str], value: float) -> bool:
    from fractions import Fraction  # noqa: PLC0415 - as above

    size = Fraction(int(found["whole"] + found["part"], 16))
    power = int(found["power"] or 0) - 4 * len(found["part"])
    return (-size if text.startswith("-") else size) * Fraction(2) ** power == value
