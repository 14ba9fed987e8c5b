"""Columns of source files: the compiler counts bytes of UTF-8, people count characters."""

from __future__ import annotations

from bisect import bisect_left
from functools import lru_cache
from typing import Final

_plain: set[str] = set()  # files of which each character is a byte
_FOLLOWING: Final = range(0x80, 0xC0)  # bytes that are not the first of their characters (RFC 3629)


def code_points(file: str, line: int, offset: int) -> int:
    """Return a column in code points for one in bytes of UTF-8, as the compiler counts."""
    if file in _plain:
        return offset
    import linecache  # noqa: PLC0415 - other files are few, and it brings in what reads Python

    text = linecache.getline(file, line)
    return offset if text.isascii() else in_code_points(text, offset)


def keep_plain(file: str, source: bytes) -> None:
    """Take note of whether a file, of which this is the text, has characters of several bytes, as it is decoded."""
    begin = source[: source.find(b"\n", source.find(b"\n") + 1)]
    (_plain.add if source.isascii() and b"coding" not in begin else _plain.discard)(file)


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
