"""Conditions as other languages write them, and names of variables without `$(var)`: what they are here."""

from __future__ import annotations

from functools import lru_cache
from typing import Final

from orchestra.patterns import pattern

_SIDE: Final = r"""(\$\((?:[^()]|\([^()]*\))*\)|'[^'$() ]*'|"[^"$() ]*"|[\w./-]+)"""
_NEGATED: Final = pattern(rf"(?:not\s+|!\s*){_SIDE}")
_COMPARED: Final = pattern(rf"{_SIDE}\s*(==?|!=|&&|\|\||\band\b|\bor\b)\s*{_SIDE}")
_NAME: Final = pattern(r"[A-Za-z_]\w*")
_GIVEN: Final = pattern(r"""\bname["']?\s*[:=]\s*["']?(?=(\w+))""")
_SUBSTITUTIONS: Final = {
    "=": "equals",
    "==": "equals",
    "!=": "not-equals",
    "&&": "and",
    "and": "and",
    "||": "or",
    "or": "or",
}


def as_substitutions(text: str, source: str = "") -> str | None:
    """Return an expression as substitutions, None for what is none.

    `source` is the file: what has the name of something that is declared or set in it is a variable.
    """
    text = text.strip()
    if _NAME.fullmatch(text):
        return f"$(var {text})" if _is_named(text, source) else None
    if (negated := _NEGATED.fullmatch(text)) is not None:
        return f"$(not {_side(negated[1], source)})"
    if (compared := _COMPARED.fullmatch(text)) is None:
        return None
    left, sign, right = compared.groups()
    return f"$({_SUBSTITUTIONS[sign]} {_side(left, source)} {_side(right, source)})"


def _side(text: str, source: str) -> str:
    return f"$(var {text})" if _NAME.fullmatch(text) and _is_named(text, source) else text


def _is_named(name: str, source: str) -> bool:
    return name in _named(source)


@lru_cache(maxsize=2)  # a file may have an expression in each of a thousand nodes
def _named(source: str) -> frozenset[str]:
    """Return the words that stand behind a key `name`."""
    return frozenset(found[1] for found in _GIVEN.finditer(source))
