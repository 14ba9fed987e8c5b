"""Whether the log of a process has all that the process wrote, to the last byte."""

from __future__ import annotations

import re
import zlib
from dataclasses import dataclass

_LINE = re.compile(rb"([oe]) (begin|end|\d{10}) ?(.*)")
_FILLING = b"xxx"


@dataclass
class _Stream:
    """What has been read of one stream: the lines of the run of the program that is going on."""

    whole: int = 0
    open: bool = False
    count: int = 0
    sum: int = 0


def check(log: bytes) -> tuple[dict[str, int], list[str]]:
    """Return for each stream (`o`, `e`) how many runs of the program are complete, and what is wrong with the rest."""
    streams = {"o": _Stream(), "e": _Stream()}
    faults: list[str] = []
    for number, line in enumerate(log.splitlines(keepends=True), 1):
        match = _LINE.fullmatch(line.rstrip(b"\n"))
        if match is None:
            if _FILLING in line:
                faults.append(f"line {number} is broken: {line[:60]!r}")
            continue  # what others say, and the interpreter where it is interrupted before our first word
        letter, what, rest = match.group(1).decode(), match.group(2), match.group(3)
        fault = _take(streams[letter], what, rest, line)
        if fault:
            faults.append(f"line {number}: {fault}")
    return {letter: stream.whole for letter, stream in streams.items()}, faults


def _take(stream: _Stream, what: bytes, rest: bytes, line: bytes) -> str | None:
    if what == b"begin":
        stream.open, stream.count, stream.sum = True, 0, 0
        return None
    if not stream.open:
        return "no run of the program has begun"
    if what != b"end":
        expected, stream.count, stream.sum = stream.count, stream.count + 1, zlib.crc32(line, stream.sum)
        return None if int(what) == expected else f"{int(what)} stands where {expected} should"
    stream.open = False
    _pid, count, checksum = rest.split()
    if (int(count), int(checksum, 16)) != (stream.count, stream.sum):
        return f"{int(count)} lines were written, {stream.count} are here, or others"
    stream.whole += 1
    return None
