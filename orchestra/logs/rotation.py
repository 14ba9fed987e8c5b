"""A file that is appended to and put away when it is large; what it could not take is counted, and told in it."""

from __future__ import annotations

import contextlib
import os
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Final, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.logs import pieces

if TYPE_CHECKING:
    from pathlib import Path

# Written at a time: after each, whoever waits can see that the disk is alive. More where it has been quick, in seconds.
_SLICE = 1 << 18
_LARGE_SLICE = 1 << 22
_QUICK = 0.1
# The kernel takes no more pieces at a time (writev(2)).
_PIECES = 1024

# Held while a file is opened: whoever lowers the limit of open files for a moment must not do so meanwhile.
OPENING: Final = threading.RLock()


@dataclass(frozen=True, slots=True)
class Rotation:
    """`size` is that of a piece in bytes, 0 for one without end; `keep` is how many older ones stay."""

    size: int = 64 * 1024 * 1024
    keep: int = 7


ENDLESS = Rotation(size=0)


@dataclass(frozen=True, slots=True)
class Form:
    """What a file looks like. `gap` tells, as a line, how many bytes are missing in the place where it stands.

    Where lines are `whole`, no part of one is left in the file when the rest could not be written.
    """

    gap: Callable[[int], bytes]
    whole: bool


Bytes: TypeAlias = bytes | memoryview


class Appended:
    """The file itself. Every call may block for as long as the disk does.

    `lost` counts the bytes it did not take; `progress` is called whenever it has taken some.
    """

    def __init__(self, path: Path, rotation: Rotation, form: Form, progress: Callable[[], None]) -> None:
        self.path = path
        self.lost = 0
        self._rotation = rotation
        self._form = form
        self._progress = progress
        self._missing = 0
        self._descriptor: int | None = None
        self._size = 0
        self._newest: int | None = None
        self._slice = _SLICE

    def append(self, pieces: Sequence[bytes]) -> OSError | None:
        """Append pieces of data; return what prevented it. What could not be written is lost."""
        try:
            self._open()
        except OSError as failure:
            self.lose(sum(map(len, pieces)))
            return failure
        size, limit = sum(map(len, pieces)), self._rotation.size
        if limit and self._size + size > limit:
            return self._append_apart(memoryview(b"".join(pieces)))
        stays, error = self._put(pieces)
        self.lose(size - stays)
        return error

    def _append_apart(self, rest: memoryview) -> OSError | None:
        """Append what does not belong into one piece of the log."""
        error = None
        while rest and error is None:
            try:
                self._open()
                room = self._room(rest)
            except OSError as failure:
                error = failure
            else:
                stays, error = self._put([rest[:room]])
                rest = rest[stays:]
        self.lose(len(rest))
        return error

    def lose(self, size: int) -> None:
        """Take note that so many bytes are not to be written."""
        self.lost += size
        self._missing += size

    def close(self) -> None:
        """Close the file; the next data opens it again."""
        if self._descriptor is not None:
            descriptor, self._descriptor = self._descriptor, None
            with contextlib.suppress(
                OSError
            ):  # late news of a disk (close(2)); the file is not open any more
                os.close(descriptor)

    def _room(self, data: memoryview) -> int:
        """Return how much of the data belongs into this piece, after beginning another where that is nothing."""
        limit = self._rotation.size
        if not limit or self._size + len(data) <= limit:
            return len(data)
        fits = bytes(data[: max(0, limit - self._size)]).rfind(b"\n") + 1
        if fits:
            return fits
        if self._size:
            self._rotate()
            return len(data) if self._size else self._room(data)
        return bytes(data).find(b"\n", limit) + 1 or len(data) if self._form.whole else limit

    def _put(self, pieces: Sequence[Bytes]) -> tuple[int, OSError | None]:
        """Write data, behind a word about the gap before it if there is one; return how much of it stays."""
        gap = self._form.gap(self._missing) if self._missing else b""
        begin = self._size
        written, error = self._write([gap, *pieces] if gap else pieces)
        stays = written - len(gap)
        if error and stays > 0 and self._form.whole:
            stays = b"".join(pieces).rfind(b"\n", 0, stays) + 1
        if stays < 0 or (error and self._form.whole):
            self._cut(begin + (len(gap) + stays if stays >= 0 else 0))
        if stays >= 0:
            self._missing = 0
        return max(0, stays), error

    def _write(self, pieces: Sequence[Bytes]) -> tuple[int, OSError | None]:
        written = 0
        try:
            for group in _groups(pieces, self._slice):
                rest = group
                began = time.monotonic()
                while rest:
                    size = os.writev(self._open(), rest)
                    written += size
                    self._progress()
                    rest = _behind(rest, size)
                self._slice = _LARGE_SLICE if time.monotonic() - began < _QUICK else _SLICE
        except OSError as error:
            return written, error
        finally:
            self._size += written
        return written, None

    def _cut(self, size: int) -> None:
        with contextlib.suppress(OSError):  # a torn line then stays, and readers leave it out
            os.ftruncate(self._open(), size)
            self._size = size

    def _rotate(self) -> None:
        """Put the piece away and remove the oldest. Where that is impossible the file just grows."""
        self.close()
        with OPENING:
            self._put_away()
        self._open()

    def _put_away(self) -> None:
        if self._newest is None:
            self._newest = max(pieces.numbers(self.path), default=0)
        with contextlib.suppress(OSError):
            if self._rotation.keep:
                self.path.rename(pieces.put_away(self.path, self._newest + 1))
                self._newest += 1
            else:
                self.path.unlink()
            for number in pieces.numbers(self.path):
                if number <= self._newest - self._rotation.keep:
                    pieces.put_away(self.path, number).unlink()

    def _open(self) -> int:
        if self._descriptor is None:
            flags = os.O_WRONLY | os.O_APPEND | os.O_CREAT | os.O_CLOEXEC | os.O_NOCTTY
            with OPENING:
                self._descriptor = os.open(self.path, flags, 0o644)
            self._size = os.fstat(self._descriptor).st_size
        return self._descriptor


def _groups(pieces: Sequence[Bytes], most: int) -> Iterator[list[Bytes]]:
    """Yield pieces that are written with one call."""
    group: list[Bytes] = []
    size = 0
    for piece in pieces:
        if size + len(piece) > most or len(group) == _PIECES:
            if group:
                yield group
            group, size = [], 0
        if len(piece) > most:
            view = memoryview(piece)
            for begin in range(0, len(piece), most):
                yield [view[begin : begin + most]]
        else:
            group.append(piece)
            size += len(piece)
    if group:
        yield group


def _behind(pieces: list[Bytes], size: int) -> list[Bytes]:
    """Return what follows the first bytes of some pieces."""
    for index, piece in enumerate(pieces):
        if size < len(piece):
            return [memoryview(piece)[size:], *pieces[index + 1 :]]
        size -= len(piece)
    return []
