"""A log and its older pieces: `all.log` is written to, `all.log.1` is the first that was put away, then `all.log.2`.

Numbers grow and a piece keeps its name until it is removed, so that a reader in the middle of one is never moved to
another (logrotate(8) moves every piece each time).
"""

from __future__ import annotations

import math
import os
from contextlib import suppress
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

_READ_SIZE = 1 << 18
# How much of an unfinished line is kept until the rest is there.
_LONGEST_LINE = 1 << 24


def numbers(path: Path) -> list[int]:
    """Return the numbers of the pieces that have been put away, the oldest first."""
    begin = f"{path.name}."
    try:
        names = os.listdir(path.parent)  # noqa: PTH208 - names are wanted, not paths
    except FileNotFoundError:
        return []
    ends = (name.removeprefix(begin) for name in names if name.startswith(begin))
    return sorted(int(end) for end in ends if end.isascii() and end.isdecimal())


def put_away(path: Path, number: int) -> Path:
    """Return the path of a piece that has been put away."""
    return path.with_name(f"{path.name}.{number}")


def oldest_first(path: Path) -> list[Path]:
    """Return every piece of a log that is there; the last is the one that is written to."""
    old = [put_away(path, number) for number in numbers(path)]
    return [*old, path] if path.exists() else old


class Follower:
    """Reads a log as it grows, from its begin or from where it ends now, and goes along when it is rotated.

    Nothing is missed unless pieces are removed faster than they are read.
    """

    def __init__(self, path: Path, *, from_now: bool = False) -> None:
        self._path = path
        self._descriptor: int | None = None
        self._held = b""
        self._done = max(numbers(path), default=0) if from_now else 0
        self._begin = 0
        if from_now and self._open(path) and self._descriptor is not None:
            end = os.fstat(self._descriptor).st_size
            # A line that is being written is read when it is whole.
            self._begin = end - len(next(_backwards(self._descriptor, end)))
            os.lseek(self._descriptor, self._begin, os.SEEK_SET)

    def lines(self) -> list[bytes]:
        """Return the whole lines that have come since, up to some hundred kilobytes; none where there are no more now.

        Raises `OSError` where the log cannot be read.
        """
        while True:
            data = self._read()
            if not data and not self._go_on():
                return []
            *whole, self._held = (self._held + data).split(b"\n")
            self._held = self._held[-_LONGEST_LINE:]
            if whole:
                return [line + b"\n" for line in whole]

    def before(self) -> Iterator[bytes]:
        """Yield the whole lines before the place from where it has been told to read, the last first.

        Raises `OSError` where the log cannot be read.
        """
        own = next((n for n in numbers(self._path) if self._is(put_away(self._path, n))), math.inf)
        if self._descriptor is not None:
            yield from _lines_before(self._descriptor, self._begin)
        for number in reversed(numbers(self._path)):
            if number < own:
                with suppress(FileNotFoundError), put_away(self._path, number).open("rb") as piece:
                    yield from _lines_before(piece.fileno(), os.fstat(piece.fileno()).st_size)

    def close(self) -> None:
        """Give the file back."""
        if self._descriptor is not None:
            os.close(self._descriptor)
            self._descriptor = None

    def _read(self) -> bytes:
        return b"" if self._descriptor is None else os.read(self._descriptor, _READ_SIZE)

    def _go_on(self) -> bool:
        """Go to the next piece; tell whether there is more to read."""
        if self._descriptor is not None:
            if self._is(self._path):
                return False
            rest = self._read()  # written between the last read and the rotation
            if rest:
                self._held += rest
                return True
            self._done = next(
                (n for n in numbers(self._path) if self._is(put_away(self._path, n))), self._done
            )
            self.close()
        return self._open_next()

    def _open_next(self) -> bool:
        """Open the piece after the last one; a rotation may come between any two of these steps."""
        found = self._open(self._path)
        for number in numbers(self._path):
            if number > self._done:
                self.close()
                if self._open(put_away(self._path, number)):
                    return True
        return found and self._descriptor is not None

    def _is(self, path: Path) -> bool:
        """Tell whether the open piece has this name."""
        if self._descriptor is None:
            return False
        try:
            return os.path.samestat(os.fstat(self._descriptor), path.stat())
        except FileNotFoundError:
            return False

    def _open(self, path: Path) -> bool:
        try:
            self._descriptor = os.open(path, os.O_RDONLY | os.O_CLOEXEC | os.O_NOCTTY)
        except FileNotFoundError:
            return False
        return True


def _lines_before(descriptor: int, end: int) -> Iterator[bytes]:
    """Yield the whole lines of a file before a place, the last first."""
    found = _backwards(descriptor, end)
    next(found)
    yield from (line + b"\n" for line in found)


def _backwards(descriptor: int, end: int) -> Iterator[bytes]:
    """Yield what stands before a place without newlines, the last first: that is empty behind a whole line."""
    held = b""
    while end > 0:
        begin = max(0, end - _READ_SIZE)
        held, *whole = (os.pread(descriptor, end - begin, begin) + held).split(b"\n")
        yield from reversed(whole)
        end = begin
    yield held
