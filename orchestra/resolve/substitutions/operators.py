"""Operators of other languages in an expression of Python, as `&&`, `||`, `!`, `=`, `=>` and `AND`."""

from __future__ import annotations

from typing import Final

from orchestra.dataclass import dataclass
from orchestra.patterns import pattern

_ELSEWHERE: Final = {"&&": "and", "||": "or", "!==": "!=", "===": "==", "=>": ">=", "=<": "<="}
_NOT: Final = "!"
_WORD: Final = pattern(r"(?<![\w'\"])(?:AND|OR|NOT|And|Or|Not|XOR|xor)(?![\w'\"])")
_WORDS: Final = {"xor": "!="}
_COMPARING: Final = "Maybe you meant '=='"  # what Python says of a single `=`


@dataclass(frozen=True, slots=True)
class Operator:
    """First and last character of an operator, the latter exclusive, and what Python has for it."""

    begin: int
    end: int
    instead: str


def foreign_operator(text: str, error: BaseException, begin: int, end: int) -> Operator | None:
    """Return the operator for whose sake an expression cannot be read between two characters, None for any other."""
    if not isinstance(error, SyntaxError):
        return None
    if _COMPARING in error.msg:
        at = text.find("=", end)
        return Operator(at, at + 1, "==") if at >= 0 else None
    for operator, instead in _ELSEWHERE.items():
        at = text.find(operator, max(0, begin - len(operator) + 1), begin + len(operator))
        if at >= 0 and at <= begin:
            return Operator(at, at + len(operator), instead)
    if text[begin : begin + 1] == "=" != text[begin + 1 : begin + 2]:
        return Operator(begin, begin + 1, "==")
    if text[begin : begin + 1] == _NOT and text[begin : begin + 2] != "!=":
        return Operator(begin, begin + 1, "not ")
    word = next((found for found in _WORD.finditer(text) if found.end() + 1 >= begin), None)
    if word is not None and word.start() <= begin:
        instead = word[0].lower()
        return Operator(*word.span(), _WORDS.get(instead, instead))
    return None
