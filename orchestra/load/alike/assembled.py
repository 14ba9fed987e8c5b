"""Expressions of forms, put together from what few expressions have been compiled to before.

`re` compiles in Python, which was half of the work to learn a form. But a form is nothing but literal text, groups, and
few expressions for values, and what these are compiled to is the same wherever they stand. So that is put together
here, twenty times as fast. It differs by version of the interpreter: for one that is not known `re` compiles all of it.
"""

from __future__ import annotations

import re
from functools import cache
from itertools import chain, repeat
from typing import TYPE_CHECKING, Any, Final, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Callable

try:
    import _sre  # type: ignore[import-not-found]
    from re import _compiler, _constants, _parser  # type: ignore[attr-defined]  # not public
except ImportError:  # another interpreter
    _sre = _compiler = _constants = _parser = None

# Of Python 3.11, 3.12 and 3.13. A number stands for what codes there are and how they are laid out.
_KNOWN: Final = frozenset({20220615, 20221023, 20230612})

# What is matched in turn: a text (as it is), an expression without groups, the beginning of a group, its end, as many
# characters as a text has, whatever stands before a character.
TEXT, EXPRESSION, OPEN, CLOSE, AS_LONG, BEFORE = range(6)
Part: TypeAlias = tuple[int, str]


def assembled(parts: list[Part]) -> re.Pattern[str]:
    """Return the pattern that matches these one after the other."""
    if getattr(_sre, "MAGIC", None) not in _KNOWN:
        return re.compile(expression(parts))
    code: list[int] = []
    opened: list[int] = []
    groups = 0
    for kind, text in parts:
        if kind == TEXT:
            code += chain.from_iterable(zip(repeat(_constants.LITERAL), map(ord, text)))
        elif kind == EXPRESSION:
            code += _compiled(text)
        elif kind == OPEN:
            code += _constants.MARK, 2 * groups
            opened.append(groups)
            groups += 1
        elif kind == AS_LONG:
            code += _repeated(len(text), len(text), _constants.ANY_ALL)
        elif kind == BEFORE:
            code += _repeated(0, _constants.MAXREPEAT, _constants.NOT_LITERAL, ord(text))
        else:
            code += _constants.MARK, 2 * opened.pop() + 1
    code.append(_constants.SUCCESS)
    made: Any = _sre.compile(None, re.UNICODE.value, code, groups, {}, (None,) * (groups + 1))
    pattern: re.Pattern[str] = made
    return pattern


def expression(parts: list[Part]) -> str:
    """Return these as the text of an expression."""
    return "".join([_WRITTEN.get(kind, str)(text) for kind, text in parts])


def escaped(text: str) -> str:
    """Return an expression for a text, with blanks and dashes as they are: an escape takes three times as long."""
    return re.escape(text).replace("\\ ", " ").replace("\\\n", "\n").replace("\\-", "-")


_WRITTEN: Final[dict[int, Callable[[str], str]]] = {
    TEXT: escaped,
    OPEN: lambda _: "(",
    CLOSE: lambda _: ")",
    AS_LONG: lambda text: f"(?s:.{{{len(text)}}})",
    BEFORE: lambda text: f"[^{re.escape(text)}]*+",
}


def _repeated(least: int, most: int, *repeated: int) -> tuple[int, ...]:
    """Return the codes that match one character again and again, and never give one back."""
    return (
        *(_constants.POSSESSIVE_REPEAT_ONE, 4 + len(repeated), least, most),
        *(*repeated, _constants.SUCCESS),
    )


@cache  # there are few
def _compiled(text: str) -> tuple[int, ...]:
    """Return what an expression is compiled to, without what tells of it beforehand, and without its end."""
    code: list[int] = _compiler._code(_parser.parse(text), 0)  # noqa: SLF001 - see above
    begin = code[1] + 1 if code[0] == _constants.INFO else 0
    return tuple(code[begin:-1])
