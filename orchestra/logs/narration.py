"""Output of one process, line by line, as records: JSON made with as little work for each line as it takes."""

from __future__ import annotations

from functools import lru_cache
from json.encoder import encode_basestring_ascii as quoted
from typing import TYPE_CHECKING, Final

from orchestra.logs.heads import heads_of
from orchestra.logs.lines import LONGEST_HELD
from orchestra.logs.terminal_text import plain

if TYPE_CHECKING:
    from collections.abc import Mapping

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
        self._held: dict[str, str] = {}
        self._last: dict[str, tuple[str, float]] = {}
        self._heads = heads_of({})
        self._pid = _NOTHING

    def begin(self, pid: int, environment: Mapping[str, str]) -> None:
        """Another run of the process begins, under this pid and with this environment."""
        self._pid = str(pid)
        self._heads = heads_of(environment)
        self._begins.clear()
        self._last.clear()

    def add(self, stream: str, text: str, now: float) -> str:
        """Return the records of the lines that a piece of output completes, each with its newline."""
        text = plain(text)
        if stream in self._held:
            text = self._held.pop(stream) + text
        end = text.rfind("\n") + 1
        if len(text) - end > LONGEST_HELD:
            text, end = text + "\n", len(text) + 1
        if end < len(text):
            self._held[stream] = text[end:]
        return self._records(stream, text[: end - 1], now) if end else ""

    def end(self, now: float) -> str:
        """Return the records of lines that were never finished."""
        held, self._held = self._held, {}
        return "".join(self._records(stream, rest, now) for stream, rest in held.items())

    def _records(self, stream: str, text: str, now: float) -> str:
        """Return the records of one line or more."""
        begin = f'{{"time": {now:.6f}, {self._begin(stream)}'
        grave, since = self._last.get(stream, (_UNKNOWN, 0.0))
        if now - since > _CONTINUES_WITHIN:
            grave = _UNKNOWN
        if "\\" not in text and self._heads.mark not in text:
            # Nothing but the ends of lines turns into a backslash and an n, and all lines have one begin.
            self._last[stream] = (grave, now)
            return begin + grave + quoted(text).replace(r"\n", f'"}}\n{begin}{grave}"') + "}\n"
        read, records = self._heads.read, []
        for line in text.split("\n"):
            found = read(line)
            if found is not None:
                grave = _graveness(*found)
            records.append(f"{begin}{grave}{quoted(line)}}}\n")
        self._last[stream] = (grave, now)
        return "".join(records)

    def _begin(self, stream: str) -> str:
        if stream not in self._begins:
            self._begins[stream] = (
                f'"process": {self._process}, "pid": {self._pid}, "stream": {quoted(stream)}, '
            )
        return self._begins[stream]


@lru_cache(maxsize=1024)
def _graveness(severity: str | None, logger: str | None) -> str:
    word = severity.lower() if severity else None
    return f'"severity": {_json(word)}, "logger": {_json(logger)}, "text": '


def _json(text: str | None) -> str:
    return _NOTHING if text is None else quoted(text)


_UNKNOWN: Final = _graveness(None, None)
