"""One line that a process, or Orchestra itself, has written, as `logs/all.jsonl` keeps it; docs/logs.md has the schema.

Bytes that are not UTF-8 are lone surrogates (PEP 383) in `text`, escaped in JSON, so that a record has them all.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.fields import fields
from orchestra.logs import pieces

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

# From the least to the gravest, in the words of rcutils.
SEVERITIES: Final = ("debug", "info", "warn", "error", "fatal")
# The stream of what Orchestra itself says.
OURS: Final = "orchestra"


@dataclass(frozen=True, slots=True)
class Record:
    """A line. `time` is in seconds since the epoch, `process` its id in the plan, None where Orchestra speaks.

    `stream` is `stdout`, `stderr` or `orchestra`. `severity` is one of `SEVERITIES` where the line says so, `logger`
    the name of the ROS logger. `text` is without the end of the line and without colours.
    """

    time: float
    process: str | None
    pid: int | None
    stream: str
    severity: str | None
    logger: str | None
    text: str


_IN_ORDER = tuple(field.name for field in fields(Record))
_NAMES = frozenset(_IN_ORDER)
_JSON = json.JSONEncoder()


def dumps(record: Record) -> str:
    """Return the record as one line of JSON, without its newline."""
    return _JSON.encode({name: getattr(record, name) for name in _IN_ORDER})


def loads(line: str | bytes) -> Record:
    """Read one line. Keys that a later version may add are left out. Raises `ValueError` where it is no record."""
    document = json.loads(line)
    if not isinstance(document, dict) or not _NAMES.issubset(document):
        raise ValueError(f"not a record of a log: {line!r}")
    return Record(**{name: document[name] for name in _NAMES})


def read(path: Path) -> Iterator[Record]:
    """Yield the records of a log, those of its older pieces first. What is no record, such as a torn line, is left out.

    Raises `OSError` where a piece that is there cannot be read.
    """
    for piece in pieces.oldest_first(path):
        with piece.open("rb") as file:
            yield from parsed(file)


def parsed(lines: Iterator[bytes]) -> Iterator[Record]:
    """Yield the records among lines."""
    for line in lines:
        try:
            yield loads(line)
        except ValueError:
            continue
