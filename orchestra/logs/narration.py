"""Output of one process as records of its lines: JSON made with as little work for each line as it takes."""

from __future__ import annotations

from functools import lru_cache
from json.encoder import encode_basestring_ascii as quoted
from typing import TYPE_CHECKING, Final

from orchestra.logs.heads import DEFAULT, format_of, heads_of
from orchestra.logs.lines import LONGEST_HELD
from orchestra.logs.terminal_text import harmless

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.logs.heads import Head

# A line without a head belongs to the message before it only where it comes at once: a message is written in one go.
_CONTINUES_WITHIN: Final = 0.05
_NOTHING: Final = "null"


class Narration:
    """The lines of a process; those of each stream in their order.

    A message of several lines has one head: the lines that follow at once are as grave as it is.
    """

    def __init__(self, process: str) -> None:
        self._process = quoted(process)
        self._begins: dict[str, str] = {}
        self._held: dict[str, bytes] = {}
        self._last: dict[str, tuple[str, float]] = {}
        self._format = DEFAULT
        self._pid = _NOTHING

    def begin(self, pid: int, environment: Mapping[str, str]) -> None:
        """Another run of the process begins, under this pid and with this environment."""
        self._pid = str(pid)
        self._format = format_of(environment)
        self._begins.clear()
        self._last.clear()

    def add(self, stream: str, lines: bytes, now: float, *, clean: bool) -> bytes:
        """Return the records of the lines that a piece of output without colours completes, each with its newline.

        `clean` says that it is harmless.
        """
        if stream in self._held:
            held = self._held.pop(stream)
            lines, clean = held + lines, clean and harmless(held)
        end = lines.rfind(b"\n") + 1
        if len(lines) - end > LONGEST_HELD:
            lines, end = lines + b"\n", len(lines) + 1
        if end < len(lines):
            self._held[stream] = lines[end:]
        return self._records(stream, lines[:end], now, clean=clean) if end else b""

    def end(self, now: float) -> bytes:
        """Return the records of lines that were never finished."""
        held, self._held = self._held, {}
        return b"".join(
            self._records(stream, rest + b"\n", now, clean=harmless(rest)) for stream, rest in held.items()
        )

    def _records(self, stream: str, lines: bytes, now: float, *, clean: bool) -> bytes:
        """Return the records of one line or more."""
        begin = f'{{"time": {now:.6f}, {self._begin(stream)}'
        grave, since = self._last.get(stream, (_UNKNOWN, 0.0))
        if now - since > _CONTINUES_WITHIN:
            grave = _UNKNOWN
        heads = heads_of(self._format)
        if not heads.among(lines):
            self._last[stream] = (grave, now)
            return _alike(begin + grave, lines, clean=clean)
        records, start = [], 0
        for end, head in heads.runs(lines):
            if head is not None:
                grave = _graveness(head)
            records.append(_alike(begin + grave, lines[start:end], clean=clean))
            start = end
        self._last[stream] = (grave, now)
        return b"".join(records)

    def _begin(self, stream: str) -> str:
        if stream not in self._begins:
            self._begins[stream] = (
                f'"process": {self._process}, "pid": {self._pid}, "stream": {quoted(stream)}, '
            )
        return self._begins[stream]


def _alike(begin: str, lines: bytes, *, clean: bool) -> bytes:
    """Return the records of lines, each with its newline, that have one begin; `clean` says that they are harmless."""
    if clean and lines.isascii():
        # Of what JSON cannot have as it stands, they can have these three alone.
        text = lines.replace(b"\\", rb"\\").replace(b'"', rb"\"").replace(b"\t", rb"\t")
        first = f'{begin}"'.encode()
        records = text.replace(b"\n", b'"}\n' + first)
        # The last end of a line has no line behind it.
        return b"".join((first, memoryview(records)[: len(records) - len(first)]))
    texts = lines[:-1].decode("utf-8", "surrogateescape").split("\n")
    return (begin + f"}}\n{begin}".join(map(quoted, texts)) + "}\n").encode()


@lru_cache(maxsize=1024)
def _graveness(head: Head) -> str:
    severity, logger = head
    word = severity.decode().lower() if severity else None
    name = logger.decode("utf-8", "surrogateescape") if logger else None
    return f'"severity": {_json(word)}, "logger": {_json(name)}, "text": '


def _json(text: str | None) -> str:
    return _NOTHING if text is None else quoted(text)


_UNKNOWN: Final = _graveness((None, None))
