"""What the begin of a line of ROS output says: how grave it is, and which logger wrote it.

The form is that of rcutils: `[INFO] [1700000000.123456789] [logger]: text`, or what RCUTILS_CONSOLE_OUTPUT_FORMAT of
the process says (https://docs.ros.org/en/jazzy/Concepts/Intermediate/About-Logging.html).

Lines that one head counts for are found together, by one regular expression: a match for each line takes several times
as long, and most programs write many lines of the same gravity one after the other.
"""

from __future__ import annotations

import re
from functools import lru_cache
from typing import TYPE_CHECKING, Final, TypeAlias

from orchestra.dataclass import dataclass

if TYPE_CHECKING:
    from collections.abc import Mapping

# A head is not longer: some formats take time that grows with the square of the length.
_LONGEST: Final = 1000

FORMAT: Final = "RCUTILS_CONSOLE_OUTPUT_FORMAT"
DEFAULT: Final = "[{severity}] [{time}] [{name}]: {message}"

_TOKENS: Final = {
    "severity": r"(?:DEBUG|INFO|WARN|ERROR|FATAL)",
    "name": r"[^\s\]]*",
    "message": r".*",
    "time": r"[0-9]+\.[0-9]+",
    "time_as_nanoseconds": r"[0-9]+",
    "date_time_with_ms": r"[0-9]{4}-[0-9]{2}-[0-9]{2} [0-9]{2}:[0-9]{2}:[0-9]{2}\.[0-9]+",
    "function_name": r".*?",
    "file_name": r".*?",
    "line_number": r"[0-9]+",
}
_TOLD: Final = ("severity", "name")
# These go on until what follows them fits.
_OPEN: Final = ("message", "function_name", "file_name")
# What no other token can contain, so that one that is followed by it ends there and nowhere else.
_ENDS: Final = ("]", " ", "\t", "\n")
_BRACED: Final = r"\{(\w+)\}"
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
_ESCAPE: Final = r"\\([abfnrtv?\\'\"])"


# What a line says of its message: the severity in capitals, the logger; None or nothing where it does not say.
Head: TypeAlias = tuple[bytes | None, bytes | None]
# Lines to the end of the last, and their head; None where they have none.
Run: TypeAlias = tuple[int, Head | None]


@dataclass(frozen=True, slots=True)
class Heads:
    """How to read the begins of lines: text and names of tokens, in turn. Without a `mark` there are no heads.

    `rare` is its first byte, `later` the mark of a line that is not the first.
    """

    parts: tuple[str, ...]
    mark: bytes | None
    rare: bytes = b""
    later: bytes = b""

    def among(self, lines: bytes) -> bool:
        """Tell whether some of the lines may have a head."""
        if self.mark is None:
            return False
        # One byte is found many times faster than two.
        return lines.startswith(self.mark) or (self.rare in lines and self.later in lines)

    def runs(self, lines: bytes) -> list[Run]:
        """Return, in their order, where lines end that one head counts for, or those before the first head."""
        return _together(self.parts, lines) if _ends_plainly(self.parts) else _one_by_one(self.parts, lines)


def format_of(environment: Mapping[str, str]) -> str:
    """Return the form of the lines of a process with this environment."""
    return environment.get(FORMAT) or DEFAULT


@lru_cache(maxsize=64)
def heads_of(written: str) -> Heads:
    """Return how to read lines that are written in a form."""
    parts = _parts(written)
    if not any(name in parts[1::2] for name in _TOLD):
        return Heads(parts, None)
    mark = parts[0].encode("utf-8", "surrogateescape")
    return Heads(parts, mark, mark[:1], b"\n" + mark)


def _together(parts: tuple[str, ...], lines: bytes) -> list[Run]:
    run, following = _run(parts)
    runs: list[Run] = []
    end = 0
    while end < len(lines):
        found = run.match(lines, end)
        if found is not None:
            end = found.end()
        else:
            follows = following.search(lines, end)
            end = follows.start() + 1 if follows else len(lines)
        runs.append((end, _told(found)))
    return runs


def _one_by_one(parts: tuple[str, ...], lines: bytes) -> list[Run]:
    single = _single(parts)
    runs: list[Run] = []
    begin = 0
    while begin < len(lines):
        end = lines.index(b"\n", begin) + 1
        runs.append((end, _told(single.match(lines, begin, min(begin + _LONGEST, end - 1)))))
        begin = end
    return runs


def _told(found: re.Match[bytes] | None) -> Head | None:
    return (found["severity"], found["name"]) if found else None


@lru_cache(maxsize=64)
def _single(parts: tuple[str, ...]) -> re.Pattern[bytes]:
    """Return what matches the begin of a line."""
    return re.compile(_pattern(parts, first=True))


@lru_cache(maxsize=64)
def _run(parts: tuple[str, ...]) -> tuple[re.Pattern[bytes], re.Pattern[bytes]]:
    """Return what matches a line and all those for which its head counts, and what finds the next head."""
    head, same, other = (_pattern(parts, first=first) for first in (True, False, None))
    # Greedy, and nothing behind it that could fail: no line is looked at twice.
    run = re.compile(b"%b.*\n(?:(?:%b|(?!%b)).*\n)*" % (head, same, other))
    return run, re.compile(b"\n(?=%b)" % other)


def _parts(written: str) -> tuple[str, ...]:
    """Return text and names of tokens, in turn, of what a line must begin with."""
    text = re.sub(_ESCAPE, lambda found: _ESCAPES.get(found[1], found[1]), written)
    # A message has lines of its own, so what stands behind it is not looked at.
    head, message, rest = text.partition("{message}")
    if "{severity}" not in head and "{name}" not in head:
        head = head + message + rest
    parts = [""]
    end = 0
    for token in re.finditer(_BRACED, head):
        if token[1] in _TOKENS:  # rcutils writes what it does not know as it stands
            parts[-1] += head[end : token.start()]
            parts += (token[1], "")
            end = token.end()
    parts[-1] += head[end:]
    return tuple(parts)


def _pattern(parts: tuple[str, ...], *, first: bool | None) -> bytes:
    """Return what matches the begin of a line.

    The `first` one names severity and logger, others refer to these; with None it is any.
    """
    pattern, seen = "", set[str]()
    for text, name in zip(parts[::2], (*parts[1::2], ""), strict=True):
        pattern += re.escape(text) + _group(name, first=first, again=name in seen)
        seen.add(name)
    if first:
        # Groups that take part in no match, so that both can be asked for.
        pattern += "".join(f"(?P<{name}>(?!))?" for name in _TOLD if name not in seen)
    return pattern.encode("utf-8", "surrogateescape")


def _group(name: str, *, first: bool | None, again: bool) -> str:
    """Return what matches a token; a group has its name once."""
    form = _TOKENS.get(name, "")
    if first is None or name not in _TOLD:
        return form
    return f"(?P<{name}>{form})" if first and not again else f"(?P={name})"


@lru_cache(maxsize=64)
def _ends_plainly(parts: tuple[str, ...]) -> bool:
    """Tell whether each token can end in one place only, so that no line takes more time than it is long."""
    names = parts[1::2]
    if len({*names}) < len(names) or any(name in _OPEN for name in names):
        return False
    behind = [
        text for name, text in zip(names, parts[2::2], strict=True) if name == "name" or text is not parts[-1]
    ]
    return "\n" not in "".join(parts[::2]) and all(text.startswith(_ENDS) for text in behind)
