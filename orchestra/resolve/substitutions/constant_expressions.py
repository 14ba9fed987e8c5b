"""Expressions of nothing but constants, as conditions are when their variables have been put in: `'sim' == 'real'`.

They give the same wherever they stand, read nothing, change nothing and warn of nothing: each is worked out once.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Final

from orchestra.patterns import pattern

_LONGEST: Final = 200
_TEXT: Final = r"""'[^'\\\n]*+'|"[^"\\\n]*+\""""
_CONSTANT: Final = (
    rf"(?:(?:not +|- *|\( *)*+(?:{_TEXT}|[0-9]++(?:\.[0-9]++)?+|True\b|False\b|None\b)(?: *\))*+)"
)
# Those that may take long are left out: shifts, powers, and texts time and again.
_OPERATOR: Final = r"(?: *+(?:[=!<>]=|<|>|\+|-|//?|%) *+| +(?:and|or|in|not +in) +)"
_CONSTANTS: Final = pattern(rf"{_CONSTANT}(?:{_OPERATOR}{_CONSTANT})*+")


@lru_cache(maxsize=512)
def of_constants(expression: str) -> str | None:
    """Return the `str` of what an expression gives; None for any other, and where it fails."""
    if len(expression) > _LONGEST or _CONSTANTS.fullmatch(expression) is None:
        return None
    try:
        text = str(eval(expression, {"__builtins__": {}}))  # noqa: S307 - of constants
    except Exception:  # noqa: BLE001 - whoever evaluates it in full tells why
        return None
    return text if len(text) <= _LONGEST else None
