"""A run in a file: rows of numbers in small compressed blocks, each with its length and checksum.

Whoever is killed while writing loses the block at hand, at most a second, and nothing before it. A block holds either
facts (JSON: robots, map, names), rows, or that all rows before it do not count; facts add to those before.
"""

from __future__ import annotations

import json
import struct
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, BinaryIO, Self

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path
    from types import TracebackType

MAGIC = b"bringup recording 1\n"
BLOCK = struct.Struct("<II")
FACTS, ROWS, AFRESH = b"F", b"R", b"A"
# x, y, yaw and, of the filter, the upper half of their covariance, row by row.
WIDTH = 9
ROW = np.dtype([("kind", "u1"), ("robot", "u1"), ("stamp", "<i8"), ("values", "<f8", (WIDTH,))])
TRUTH, WHEELS, FILTERED, CONTACTS, NIS = range(5)


class RecordingError(ValueError):
    """A file is no recording; the message names it."""


class Writer:
    """Writes a recording; use it in a `with` block."""

    def __init__(self, path: Path) -> None:
        self._file: BinaryIO = path.open("wb")
        self._file.write(MAGIC)
        self._pending: list[tuple[int, int, int, tuple[float, ...]]] = []

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Write what is kept, and no more."""
        self.flush()
        self._file.close()

    def tell(self, facts: Mapping[str, Any]) -> None:
        """Write facts down at once."""
        self._block(FACTS + json.dumps(facts).encode())

    def add(self, kind: int, robot: int, stamp: int, values: Sequence[float]) -> None:
        """Keep a row until the next flush; `robot` is a place in the fact `robots`, `stamp` nanoseconds."""
        self._pending.append((kind, robot, stamp, (*values, *(0.0,) * (WIDTH - len(values)))))

    def begin_afresh(self) -> None:
        """Make all rows so far count no more; facts stay."""
        self._pending.clear()
        self._block(AFRESH)

    def flush(self) -> None:
        """Write what is kept."""
        if self._pending:
            self._block(ROWS + np.array(self._pending, dtype=ROW).tobytes())
            self._pending.clear()

    def _block(self, content: bytes) -> None:
        packed = zlib.compress(content)
        self._file.write(BLOCK.pack(len(packed), zlib.crc32(packed)) + packed)
        self._file.flush()


@dataclass(frozen=True, slots=True, eq=False)
class Recording:
    """What a file holds; `whole` is False where its last block is broken off."""

    facts: Mapping[str, Any]
    rows: NDArray[np.void]
    whole: bool

    def of(self, kind: int, robot: int) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
        """Stamps (ns) and values of one kind for one robot, in the order of their stamps."""
        chosen = self.rows[(self.rows["kind"] == kind) & (self.rows["robot"] == robot)]
        stamps, first = np.unique(chosen["stamp"], return_index=True)
        return stamps, chosen["values"][first]


def read(path: Path) -> Recording:
    """Read a recording, as far as it goes. Raises OSError, RecordingError."""
    content = path.read_bytes()
    if not content.startswith(MAGIC):
        raise RecordingError(f"{path} is no recording")
    facts: dict[str, Any] = {}
    rows = [np.zeros(0, ROW)]
    place = len(MAGIC)
    while (packed := _packed(content, place)) is not None:
        place += BLOCK.size + len(packed)
        block = zlib.decompress(packed)
        if block.startswith(FACTS):
            facts.update(json.loads(block[1:]))
        elif block.startswith(AFRESH):
            del rows[1:]
        else:
            rows.append(np.frombuffer(block[1:], dtype=ROW))
    return Recording(facts, np.concatenate(rows), whole=place == len(content))


def _packed(content: bytes, place: int) -> bytes | None:
    """The block at a place, or None if there is no whole one."""
    if len(content) < place + BLOCK.size:
        return None
    length, checksum = BLOCK.unpack_from(content, place)
    packed = content[place + BLOCK.size : place + BLOCK.size + length]
    return packed if len(packed) == length and zlib.crc32(packed) == checksum else None
