"""Operators of other languages in an expression of Python, as `&&`, `||`, `!`, `=` and `=>`."""

from __future__ import annotations

from typing import Final

from orchestra.dataclass import dataclass

_ELSEWHERE: Final = {"&&": "and", "||": "or", "!==": "!=", "===": "==", "=>": ">=", "=<": "<="}
_NOT: Final = "!"
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
    return None
