"""Expressions of nothing but constants, as conditions are when their variables have been put in: `'sim' == 'real'`.

They give the same wherever they stand, read nothing, change nothing and warn of nothing: each is worked out once.
"""

from __future__ import annotations

import operator
from functools import lru_cache
from typing import Any, Final

from orchestra.patterns import pattern

_LONGEST: Final = 200
TEXT: Final = r"""'[^'\\\n]*+'|"[^"\\\n]*+\""""
# What calculates. What may take long is left out: shifts, powers, and texts time and again.
FUNCTIONS: Final[dict[str, Any]] = {
    function.__name__: function for function in (abs, bool, float, int, len, max, min, round, str)
}
_METHODS: Final = (
    *("capitalize", "count", "endswith", "find", "index", "isalnum", "isalpha", "isdigit", "isnumeric"),
    *("lower", "lstrip", "removeprefix", "removesuffix", "replace", "rstrip", "split", "startswith"),
    *("strip", "title", "upper"),
)
_KEYWORDS: Final = ("and", "else", "if", "in", "not", "or")
_WORDS: Final = "|".join((*_KEYWORDS, "True", "False", "None", *FUNCTIONS))
CODE: Final = rf"(?:{_WORDS})(?!\w)|[=!<>]=|<(?!<)|>(?!>)|[%+(),[\]-]|//?|\.(?:{'|'.join(_METHODS)})(?=\()"
# Code that only makes sense to be warned of: a bracket right behind a value.
MISUSED: Final = pattern(r"""(?:['"\])0-9]|(?:True|False|None)) *[(\[]""")
# Two texts or two whole numbers, as most of them are.
_COMPARISON: Final = pattern(
    rf"(?:({TEXT})|(0|[1-9][0-9]*+)) *+([=!<>]=|[<>]) *+(?:({TEXT})|(0|[1-9][0-9]*+))"
)
_COMPARED: Final[dict[str, Any]] = {
    "==": operator.eq,
    "!=": operator.ne,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
}
_NUMBER: Final = r"[0-9]++(?:\.[0-9]++)?+(?![\w.])"
_CONSTANTS: Final = pattern(rf"(?: |{TEXT}|{_NUMBER}|{CODE})++")
# With products, where there is nothing that could be repeated.
_NUMBERS: Final = pattern(
    rf"(?: |{_NUMBER}|(?:and|or|not|if|else|True|False|abs|bool|float|int|round)(?!\w)"
    r"|[=!<>]=|<(?!<)|>(?!>)|\*(?!\*)|[%+()-]|//?)++"
)


@lru_cache(maxsize=512)
def of_constants(expression: str) -> str | None:
    """Return the `str` of what an expression gives; None for any other, and where it fails."""
    if len(expression) > _LONGEST:
        return None
    found = _COMPARISON.fullmatch(expression)
    if found is not None:
        text, number, compared, other_text, other_number = found.groups()
        if text is not None and other_text is not None:
            return str(_COMPARED[compared](text[1:-1], other_text[1:-1]))
        if number is not None and other_number is not None:
            return str(_COMPARED[compared](int(number), int(other_number)))
    if _CONSTANTS.fullmatch(expression) is None and (
        "*" not in expression or _NUMBERS.fullmatch(expression) is None
    ):
        return None
    if MISUSED.search(expression) is not None:
        return None
    try:
        text = str(eval(expression, {"__builtins__": FUNCTIONS}))  # noqa: S307 - of constants
    except Exception:  # noqa: BLE001 - whoever evaluates it in full tells why
        return None
    return text if len(text) <= _LONGEST else None
