"""Conditions as other languages write them, and names of variables without `$(var)`: what they are here."""

from __future__ import annotations

from functools import lru_cache
from typing import Final

from orchestra.dataclass import dataclass
from orchestra.patterns import pattern

_TOKEN: Final = pattern(
    r"""\s*(\$\((?:[^()]|\([^()]*\))*\)|'[^'$() ]*'|"[^"$() ]*"|==?|!=|&&|\|\||!|[()]|[\w./-]+)\s*"""
)
_NAME: Final = pattern(r"[A-Za-z_]\w*")
_GIVEN: Final = pattern(r"""\bname["']?\s*[:=]\s*["']?(?=(\w+))""")
# What joins two sides, from what binds least to what binds most.
_OPERATORS: Final = (
    {"||": "or", "or": "or"},
    {"&&": "and", "and": "and"},
    {"=": "equals", "==": "equals", "!=": "not-equals"},
)
_MOST: Final = 100  # tokens of an expression that somebody writes
_NEGATIONS: Final = ("not", "!")
_WORDS: Final = frozenset({*_NEGATIONS, "(", ")"}.union(*_OPERATORS))


def as_substitutions(text: str, source: str = "") -> str | None:
    """Return an expression as substitutions, None for what is none.

    `source` is the file: what has the name of something that is declared or set in it is a variable.
    """
    text = text.strip()
    if _NAME.fullmatch(text):
        return f"$(var {text})" if _is_named(text, source) else None
    tokens, at = list[str](), 0
    while at < len(text):
        found = _TOKEN.match(text, at)
        if found is None:
            return None
        tokens.append(found[1])
        at = found.end()
    if not 1 < len(tokens) < _MOST:
        return None
    reading = _Reading(tokens[::-1], source)
    read = reading.joined()
    return None if reading.tokens or reading.lost else read


@dataclass(slots=True)
class _Reading:
    """Reads the tokens of an expression, of which the next one is the last; `lost` where they are none."""

    tokens: list[str]
    source: str
    lost: bool = False

    def joined(self, level: int = 0) -> str:
        """Return what sides come to that operators of a level, or of one that binds more, join."""
        if level == len(_OPERATORS):
            return self.side()
        if level == len(_OPERATORS) - 1 and self.tokens and self.tokens[-1] in _NEGATIONS:
            self.tokens.pop()
            return f"$(not {self.joined(level)})"
        read, operators = self.joined(level + 1), _OPERATORS[level]
        while self.tokens and self.tokens[-1] in operators:
            read = f"$({operators[self.tokens.pop()]} {read} {self.joined(level + 1)})"
        return read

    def side(self) -> str:
        """Return what one side comes to, which may be in brackets."""
        token = self.tokens.pop() if self.tokens else ""
        if token == "(":  # noqa: S105 - of an expression
            read = self.joined()
            self.lost |= not self.tokens or self.tokens.pop() != ")"
            return read
        self.lost |= not token or token in _WORDS
        return f"$(var {token})" if _NAME.fullmatch(token) and _is_named(token, self.source) else token


def _is_named(name: str, source: str) -> bool:
    return name in _named(source)


@lru_cache(maxsize=2)  # a file may have an expression in each of a thousand nodes
def _named(source: str) -> frozenset[str]:
    """Return the words that stand behind a key `name`."""
    return frozenset(found[1] for found in _GIVEN.finditer(source))
