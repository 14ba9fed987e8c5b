"""Whether a launch file may have certain mistakes, as a short look tells: to find them takes a syntax tree."""

from __future__ import annotations

import re
from functools import cache
from types import CodeType, FunctionType
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from types import ModuleType

_PIECE: Final = 16  # names of a dictionary that are one constant, at most
_KEY: Final = re.compile(rb"""[{}]|(['"])([^'"\n\\]+)\1\s*:""")
_SIGN: Final = re.compile(rb"""oin(?:Substitution)?\((?:[^()]|\([^()]*\))*?,\s*['"]/""")
# A line outside of functions in which a dictionary may stand, or behind which a part of the same statement does.
_OUTSIDE: Final = re.compile(
    rb"\n(?!from |import |[#\s])(?:.*(?:\{|[(\[,\\][ \t\r]*$)"
    rb"|(?:async|class|el|except|finally|for|if|match|try|w[hi]))",
    re.MULTILINE,
)
_BLANKS: Final = b" \t\r\n\f"
_QUOTES: Final = b"'\""
_OPTIONS: Final = (b"'-", b'"-')
_TOPICS: Final = (b"'/", b'"/')


def has_doubled_keys(module: ModuleType, source: bytes) -> bool:
    """Return whether a name may stand twice in a dictionary of a file, of which this is the text.

    The names of a short dictionary are one constant; those of a long one are added to it one after the other.
    """
    codes = (item.__code__ for item in vars(module).values() if type(item) is FunctionType)
    own = [code for code in codes if code.co_filename == module.__file__]
    if any(map(_repeats, own)):
        return True
    may_stand = any(map(_lists_names, own)) or _OUTSIDE.search(b"\n" + source) is not None
    return may_stand and source.count(b"':") + source.count(b'":') > _PIECE and _doubles(source)


def _repeats(code: CodeType) -> bool:
    """Return whether a text is twice in one constant."""
    for item in code.co_consts:
        if type(item) is tuple:
            if len(set(item)) < len(item) and _repeats_text(item):
                return True
        elif type(item) is CodeType and _repeats(item):
            return True
    return False


def _repeats_text(items: tuple[object, ...]) -> bool:
    """Return whether a text is twice among others, as numbers often are."""
    texts = [item for item in items if type(item) is str]
    return len(set(texts)) < len(texts)


def _lists_names(code: CodeType) -> bool:
    """Return whether a dictionary is made of names that are not one constant."""
    written = code.co_code
    adding, building = _instructions()
    if adding in written[::2] or building.search(written) is not None:
        return True
    return any(_lists_names(item) for item in code.co_consts if type(item) is CodeType)


@cache
def _instructions() -> tuple[int, re.Pattern[bytes]]:
    """Return the operation that adds to a dictionary, and the instructions that make one of several names at once."""
    from opcode import opmap  # noqa: PLC0415 - once

    several = b"[" + re.escape(bytes(range(2, _PIECE))) + b"]"
    return opmap["MAP_ADD"], re.compile(re.escape(bytes((opmap["BUILD_MAP"],))) + several)


def _doubles(source: bytes) -> bool:
    """Return whether a name stands twice between the same braces, as far as a look at the text tells."""
    around: list[set[bytes]] = []
    for sign in _KEY.finditer(source):
        key = sign[2]
        if key is None:
            if sign[0] == b"{":
                around.append(set())
            elif around:
                around.pop()
        elif around:
            if key in around[-1]:
                return True
            around[-1].add(key)
    return False


def has_late_roots(source: bytes) -> bool:
    """Return whether a later part of a path may begin with a slash."""
    return _SIGN.search(source) is not None


def has_joined_words(source: bytes) -> bool:
    """Return whether an option, or a topic of a bridge, may stand in quotes right behind another text."""
    signs = _OPTIONS if b"@" not in source else (*_OPTIONS, *_TOPICS)
    return any(_is_behind_text(source, sign) for sign in signs)


def _is_behind_text(source: bytes, sign: bytes) -> bool:
    place = source.find(sign)
    while place > 0:
        last = place - 1
        while last > 0 and source[last] in _BLANKS:
            last -= 1
        if last < place - 1 and source[last] in _QUOTES:
            return True
        place = source.find(sign, place + 2)
    return False
