"""What the begin of a line of ROS output says: how grave it is, and which logger wrote it.

The form is that of rcutils: `[INFO] [1700000000.123456789] [logger]: text`, or what RCUTILS_CONSOLE_OUTPUT_FORMAT of
the process says (https://docs.ros.org/en/jazzy/Concepts/Intermediate/About-Logging.html).
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import lru_cache
from typing import TYPE_CHECKING, Final, TypeAlias

from orchestra.dataclass import dataclass

if TYPE_CHECKING:
    from collections.abc import Mapping

# From a line without colours to its severity, in capitals, and its logger; None where it has no head.
Read: TypeAlias = Callable[[str], tuple[str | None, str | None] | None]

# A head is not longer: some formats take time that grows with the square of the length.
_LONGEST: Final = 1000
# Stands in no line.
_NEVER: Final = "\n\n"

FORMAT: Final = "RCUTILS_CONSOLE_OUTPUT_FORMAT"
DEFAULT: Final = "[{severity}] [{time}] [{name}]: {message}"

_TOKENS: Final = {
    "severity": r"(?P<severity>DEBUG|INFO|WARN|ERROR|FATAL)",
    "name": r"(?P<name>[^\s\]]*)",
    "message": r".*",
    "time": r"\d+\.\d+",
    "time_as_nanoseconds": r"\d+",
    "date_time_with_ms": r"\d{4}-\d\d-\d\d \d\d:\d\d:\d\d\.\d+",
    "function_name": r".*?",
    "file_name": r".*?",
    "line_number": r"\d+",
}
_TOKEN = re.compile(r"\{(\w+)\}")
# How rcutils reads them in a format.
_ESCAPES: Final = {
    "a": "\a",
    "b": "\b",
    "f": "\f",
    "n": "\n",
    "r": "\r",
    "t": "\t",
    "v": "\v",
    "\\": "\\",
    "?": "?",
}
_ESCAPE = re.compile(r"\\([abfnrtv?\\'\"])")


@dataclass(frozen=True, slots=True)
class Heads:
    """How to read the begin of a line. Where `mark` is not in a text, none of its lines has a head."""

    mark: str
    read: Read


def heads_of(environment: Mapping[str, str]) -> Heads:
    """Return how to read the lines of a process with this environment."""
    return _heads(environment.get(FORMAT) or DEFAULT)


@lru_cache(maxsize=64)
def _heads(written: str) -> Heads:
    pattern = _pattern(written)
    if pattern is None:
        return Heads(_NEVER, lambda _line: None)
    first = written[:1]
    return Heads("" if first in "{\\" else first, _reader(pattern))


def _reader(pattern: re.Pattern[str]) -> Read:
    match = pattern.match
    severity, name = (pattern.groupindex.get(group) for group in ("severity", "name"))

    def read(line: str) -> tuple[str | None, str | None] | None:
        found = match(line, 0, _LONGEST)
        if found is None:
            return None
        return found[severity] if severity else None, (found[name] or None) if name else None

    return read


def _pattern(written: str) -> re.Pattern[str] | None:
    """Return what matches the begin of a line; None where the format tells neither severity nor logger."""
    text = _ESCAPE.sub(lambda found: _ESCAPES.get(found[1], found[1]), written)
    # A message has lines of its own, so what stands behind it is not looked at.
    head, message, rest = text.partition("{message}")
    if "{severity}" not in head and "{name}" not in head:
        head = head + message + rest
    parts: list[str] = []
    end, seen = 0, set()
    for token in _TOKEN.finditer(head):
        name = token[1]
        if name not in _TOKENS:
            continue  # rcutils writes what it does not know as it stands
        parts += (re.escape(head[end : token.start()]), _again(name) if name in seen else _TOKENS[name])
        seen.add(name)
        end = token.end()
    parts.append(re.escape(head[end:]))
    if not seen & {"severity", "name"}:
        return None
    return re.compile("".join(parts))


def _again(name: str) -> str:
    """Return what matches a token for the second time; a group has its name once."""
    return f"(?P={name})" if name in ("severity", "name") else _TOKENS[name]
