"""Slips that leave no Python: a keyword that is misspelt, a quote that is missing or another on one side of a word.

CPython tells of them where it gives up, words later, or at the next quote. A slip is told only where the file reads
further with the word as it was meant.
"""

from __future__ import annotations

import re
from itertools import islice
from keyword import kwlist
from typing import TYPE_CHECKING, Final, TypeAlias

from orchestra.nearest import is_slip

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

_Slip = tuple[int, int, str]  # first and last column from 0, what was meant
_Maker: TypeAlias = "Callable[[str, int], Iterator[_Slip]]"
_WORD: Final = re.compile(r"[A-Za-z_]\w*")
_HALF_QUOTED: Final = re.compile(
    r"""(?<![\w'"./-])(?:(["'])([\w./-]+)(?=[,)\]}:]|$)|([\w./-]+)(["'])(?=[,)\]}:]))"""
)
_TWO_QUOTES: Final = re.compile(r"""(?<![\w'"./-])(?:'([\w./-]+)"|"([\w./-]+)')(?=[,)\]}:])""")
_PRINT: Final = re.compile(r"\bprint\s+(?![(=])(.+?)[ \t]*$")
_SIGN: Final = re.compile(r"(?<![=!<>:+*/-])[=:](?!=)")
_FOREIGN: Final = re.compile(r"=>|;")
_MEANT: Final = {"=>": ("=", ":"), ";": (",",)}
_CLOSED: Final = re.compile(r"closing parenthesis .* does not match opening parenthesis '(.)'")
_CLOSERS: Final = {"(": ")", "[": "]", "{": "}"}
_QUOTED_NAME: Final = re.compile(r"""(["'])([A-Za-z_]\w*)\1\s*[:=](?!=)\s*""")
_ROUND: Final = re.compile(
    r"""([\u2018\u2019\u201a\u201c\u201d\u201e])([^\u2018\u2019\u201c\u201d'"]*)[\u2018\u2019\u201c\u201d'"]"""
)
_KEY: Final = re.compile(r"""((["'])[\w./-]+\2)(?=\s+[\w'"\[{(-])""")
_VALUE: Final = re.compile(r"""([\w.'"\])}-]+)(?=\s+['"])""")
_MOST: Final = 12  # words that are tried
_SHORT: Final = 2  # letters that make any two words alike


def slip_in(error: SyntaxError, lines: Sequence[str]) -> _Slip | None:
    """Return the slip in the line that CPython marks, None where there is none that explains the error."""
    line, message = error.lineno or 1, error.msg or ""
    if line > len(lines):
        return None
    text = lines[line - 1]
    end = (error.offset or 1) - 1
    ways = (
        slip
        for words, makers in _WAYS.items()
        if words in message
        for make in makers
        for slip in make(text, end)
    )
    return next((slip for slip in islice(ways, _MOST) if _reads_beyond(_with(lines, line, slip), line)), None)


def other_bracket(error: SyntaxError, lines: Sequence[str]) -> _Slip | None:
    """Return a bracket of another kind than the one that it closes, where the file is Python with that of its kind."""
    closed, line, at = _CLOSED.match(error.msg or ""), error.lineno or 1, (error.offset or 1) - 1
    if closed is None or line > len(lines):
        return None
    slip = (at, at + 1, _CLOSERS[closed[1]])
    return slip if _reads_beyond(_with(lines, line, slip), len(lines)) else None


def _with(lines: Sequence[str], line: int, slip: _Slip) -> str:
    """Return the text of a file with what was meant in place of a slip."""
    begin, end, meant = slip
    text = lines[line - 1]
    return "".join([*lines[: line - 1], f"{text[:begin]}{meant}{text[end:]}", *lines[line:]])


def _misspelt(text: str, _: int) -> Iterator[_Slip]:
    """Yield the words of a line that may stand for a keyword."""
    for found in _WORD.finditer(text):
        word = found[0]
        if word not in kwlist and len(word) >= _SHORT:
            meant = (known for known in kwlist if is_slip(word, known))
            yield from ((*found.span(), known) for known in sorted(meant, key=_unlike(word)))


def _printing(text: str, _: int) -> Iterator[_Slip]:
    """Yield a statement of Python 2 as a call."""
    for found in _PRINT.finditer(text):
        yield (*found.span(), f"print({found[1]})")


def _other_signs(text: str, _: int) -> Iterator[_Slip]:
    """Yield the signs of a line that may stand for others: a dictionary has `:`, a call has `=`."""
    for found in _SIGN.finditer(text):
        yield (*found.span(), ":" if found[0] == "=" else "=")
    for found in _FOREIGN.finditer(text):
        yield from ((*found.span(), sign) for sign in _MEANT[found[0]])


def _quoted_names(text: str, _: int) -> Iterator[_Slip]:
    """Yield the names of arguments that stand in quotes, as the names in a dictionary do."""
    for found in _QUOTED_NAME.finditer(text):
        yield (*found.span(), f"{found[2]}=")


def _round_quotes(text: str, _: int) -> Iterator[_Slip]:
    """Yield texts with the quotes of printed text around them."""
    for found in _ROUND.finditer(text):
        quote = '"' if found[1] in "\u201c\u201d\u201e" else "'"
        yield (*found.span(), f"{quote}{found[2]}{quote}")


def _gaps(text: str, _: int) -> Iterator[_Slip]:
    """Yield what may lack the colon of a dictionary, or the comma between two of its entries."""
    for found in _KEY.finditer(text):
        yield (*found.span(), f"{found[1]}:")
    for found in _VALUE.finditer(text):
        yield (*found.span(), f"{found[1]},")


def _colon(text: str, end: int) -> Iterator[_Slip]:  # noqa: ARG001 - as the others
    """Yield the colon that is missing."""
    yield end, end, ":"


def _unlike(word: str) -> Callable[[str], tuple[bool, int]]:
    """Return what sorts the keywords of the very same letters first, then those of the same length."""
    return lambda known: (sorted(known) != sorted(word), abs(len(known) - len(word)))


def _half_quoted(text: str, _: int) -> Iterator[_Slip]:
    """Yield the words of a line that have a quote on one side only, or two different ones."""
    for found in _HALF_QUOTED.finditer(text):
        quote, word = (found[1], found[2]) if found[1] else (found[4], found[3])
        yield (*found.span(), f"{quote}{word}{quote}")
    for found in _TWO_QUOTES.finditer(text):
        quote = found[0][0]
        yield (*found.span(), f"{quote}{found[1] or found[2]}{quote}")


def _reads_beyond(source: str, line: int) -> bool:
    """Return whether a text is Python as far as the end of a line."""
    # Here, because only mistakes need it.
    from ast import parse  # noqa: PLC0415

    parsing: Callable[[str], object] = parse
    try:
        parsing(source)
    except SyntaxError as error:
        return (error.lineno or 0) > line
    except ValueError:  # a character that no text has
        return False
    return True


# What may be meant, by what CPython says.
_WAYS: Final[dict[str, tuple[_Maker, ...]]] = {
    "unterminated string": (_half_quoted,),
    "call to 'print'": (_printing,),
    "expected ':'": (_misspelt, _other_signs, _colon),
    "invalid character": (_round_quotes,),
    "cannot assign to": (_other_signs,),
    "expression cannot contain assignment": (_quoted_names,),
    "forgot a comma": (_gaps,),
    "invalid syntax": (_misspelt, _other_signs, _quoted_names),
    "expected": (_misspelt, _other_signs),
}
