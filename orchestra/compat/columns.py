"""Columns of source files: the compiler counts bytes of UTF-8, people count characters."""

from __future__ import annotations

import linecache
from bisect import bisect_left
from functools import lru_cache
from typing import Final

_FOLLOWING: Final = range(0x80, 0xC0)  # bytes that are not the first of their characters (RFC 3629)


def code_points(file: str, line: int, offset: int) -> int:
    """Return a column in code points for one in bytes of UTF-8, as the compiler counts."""
    text = linecache.getline(file, line)
    return offset if text.isascii() else in_code_points(text, offset)


def in_code_points(text: str, offset: int) -> int:
    """Return the same for a line that is given."""
    length, following = _bytes(text)
    offset = min(offset, length)
    return offset - bisect_left(following, offset)


@lru_cache(maxsize=8)  # a whole file may stand on one line
def _bytes(text: str) -> tuple[int, list[int]]:
    """Return how many bytes a line has, and which of them are not the first of their characters."""
    encoded = text.encode(errors="surrogatepass")
    return len(encoded), [at for at, byte in enumerate(encoded) if byte in _FOLLOWING]
