"""Many results in few files, each with what it depends on; safe with many that read and write at once.

A file is written as a whole and never changed. It begins with an index: where in it each result is, and what results
share of that on which they depend, which is there once. Both are as `marshal` writes them, which takes a fifth of the
time of JSON: of a file that others may have written, or that is not what it was, nothing is read. Whoever looks for one
result reads the indexes, and the file that has it. A file that is damaged, or of another version, counts as none.
Rejected: a file for each result, where a thousand of them took the file system a third of the time in which they were
found; a database, which takes longer to import than most checks.
"""

from __future__ import annotations

import json
import marshal
import os
import time
from contextlib import suppress
from itertools import count
from typing import TYPE_CHECKING, Any, Final

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.witness.digest import digest_of
from orchestra.witness.record import Record
from orchestra.witness.store import replaced, status_of_ours

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

_ENDING: Final = ".batch"
_MOST: Final = 32 * 1024 * 1024  # bytes that all may take together
_FILES: Final = 12  # above which they become one
_FORMAT: Final = 2  # of `marshal`: in later ones the same data may look otherwise


@dataclass(slots=True)
class _Batch:
    """One file: in `entries` begin and end of each result by its name, and the numbers of the `parts` it has."""

    path: str
    digest: str
    entries: dict[str, tuple[int, int, list[int]]]
    parts: list[tuple[int, int]]
    body: bytes | None = None
    records: dict[int, Record] = field(default_factory=dict)

    def line(self, place: tuple[int, int] | tuple[int, int, list[int]]) -> bytes:
        """Return what is at a place. Raises `OSError` and `ValueError` where the file is not what it was."""
        if self.body is None:
            with open(self.path, "rb") as file:
                file.readline()
                body = file.read()
            if digest_of(body) != self.digest:
                raise ValueError("damaged")
            self.body = body
        return self.body[place[0] : place[1]]

    def part(self, number: int) -> Record:
        """Return a part of what results depend on: the same object each time."""
        if number not in self.records:
            self.records[number] = Record.from_data(marshal.loads(self.line(self.parts[number])))  # noqa: S302 - ours
        return self.records[number]


class Batches:
    """The results in one folder, which need not exist."""

    def __init__(self, folder: str, most: int = _MOST) -> None:
        self._folder = folder
        self._most = most
        self._numbers = count()
        self._found = {name: batch for batch in self._batches() for name in batch.entries}

    @property
    def is_empty(self) -> bool:
        """Whether there was none when this began."""
        return not self._found

    def read(self, key: str) -> tuple[Record, Any] | None:
        """Return what a result depends on, and the result; None where there is none that can be read."""
        name = _name(key)
        batch = self._found.get(name)
        if batch is None:
            return None
        try:
            place = batch.entries[name]
            found = marshal.loads(batch.line(place))  # noqa: S302 - ours
            if found["key"] != key:
                return None
            record = Record.from_data(found["record"])
            record.parts = [batch.part(number) for number in place[2]]
            return record, found["result"]
        except (OSError, EOFError, ValueError, KeyError, TypeError, IndexError):
            return None

    def write(self, results: Iterable[tuple[str, Record, Any]]) -> None:
        """Keep results, each with its key and record, in place of any earlier ones. Where the disk refuses, none is."""
        writing = _Writing()
        shared = _Shared(writing)
        for key, record, result in results:
            if not record.unknown:
                own = record.as_data() | {"variables": {}, "names": ""}
                content = _encoded({"key": key, "record": own, "result": result})
                writing.entry(_name(key), content, sorted(shared.numbers(record)))
        self._write(writing)

    def tidy(self) -> None:
        """Make one file of many, and forget what was kept first where there is too much."""
        paths = self._paths()
        size = sum(status.st_size for path in paths if (status := _status(path)))
        if len(paths) <= _FILES and size <= self._most:
            return
        batches = list(self._batches())
        latest = {name: batch for batch in batches for name in batch.entries}
        writing = _Writing()
        for name, batch in reversed(latest.items()):
            if writing.size > self._most // 2:
                break
            with suppress(OSError, ValueError):  # it is damaged, or somebody else does the same
                place = batch.entries[name]
                line = batch.line(place)
                parts = [writing.part(batch.line(batch.parts[number])) for number in place[2]]
                writing.entry(name, line, parts)
        self._write(writing)
        for path in paths:  # those that cannot be read as well
            with suppress(OSError):  # as above
                os.unlink(path)

    def _write(self, writing: _Writing) -> None:
        if writing.entries:
            name = f"{time.time_ns():020}-{os.getpid()}-{next(self._numbers)}{_ENDING}"
            replaced(os.path.join(self._folder, name), writing.content())

    def _paths(self) -> list[str]:
        try:
            names = sorted(name for name in os.listdir(self._folder) if name.endswith(_ENDING))
        except OSError:
            return []
        return [os.path.join(self._folder, name) for name in names]

    def _batches(self) -> Iterator[_Batch]:
        """Yield those that can be read, the latest last."""
        for path in self._paths():
            try:
                with open(path, "rb") as file:
                    if status_of_ours(file) is None:
                        continue
                    digest, _, line = file.readline().rstrip(b"\n").partition(b" ")
                if digest.decode("ascii", "replace") == digest_of(line):
                    index = json.loads(line)
                    yield _Batch(path, index["body"], index["entries"], index["parts"])
            except (OSError, ValueError, KeyError, TypeError):
                continue


class _Writing:
    """A batch that grows."""

    def __init__(self) -> None:
        self.entries: dict[str, tuple[int, int, list[int]]] = {}
        self.size = 0
        self._parts: dict[bytes, int] = {}
        self._places: list[tuple[int, int]] = []
        self._lines: list[bytes] = []

    def part(self, line: bytes) -> int:
        """Return the number of a part, which is there once."""
        if line not in self._parts:
            self._parts[line] = len(self._parts)
            self._places.append(self._put(line))
        return self._parts[line]

    def entry(self, name: str, line: bytes, parts: list[int]) -> None:
        """Add a result."""
        self.entries[name] = (*self._put(line), parts)

    def content(self) -> bytes:
        """Return what is to be in the file."""
        body = b"".join(self._lines)
        index = json.dumps({"entries": self.entries, "parts": self._places, "body": digest_of(body)}).encode()
        return digest_of(index).encode() + b" " + index + b"\n" + body

    def _put(self, line: bytes) -> tuple[int, int]:
        first, self.size = self.size, self.size + len(line)
        self._lines.append(line)
        return first, self.size


class _Shared:
    """Adds to a batch what results depend on and others may depend on as well, each part of it once."""

    def __init__(self, writing: _Writing) -> None:
        self._writing = writing
        self._parts: dict[Record, frozenset[int]] = {}
        self._environments: dict[tuple[Any, ...], int] = {}

    def numbers(self, record: Record) -> set[int]:
        """Return the numbers of a result's parts, of theirs, and of the variables that were read."""
        found, known = {self._environment(record)}, self._parts
        for part in record.parts:
            found |= known[part] if part in known else self._part(part)
        return found

    def _part(self, part: Record) -> frozenset[int]:
        if part not in self._parts:
            own = self._writing.part(_encoded(part.as_data()))
            self._parts[part] = frozenset({own}.union(*map(self._part, part.parts)))
        return self._parts[part]

    def _environment(self, record: Record) -> int:
        """Return the number of what was read of the environment: most files of a project read the same."""
        key = (record.names, *record.variables.items())
        if key not in self._environments:
            read = Record(variables=record.variables, names=record.names)
            self._environments[key] = self._writing.part(_encoded(read.as_data()))
        return self._environments[key]


def _name(key: str) -> str:
    return digest_of(key.encode("utf-8", "surrogatepass"))


def _encoded(data: Any) -> bytes:
    try:
        return marshal.dumps(data, _FORMAT)
    except ValueError:  # some of it is of a class that is derived from that of the data
        return marshal.dumps(json.loads(json.dumps(data)), _FORMAT)


def _status(path: str) -> os.stat_result | None:
    try:
        return os.stat(path)
    except OSError:
        return None
