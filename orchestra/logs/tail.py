"""The last lines of a process, for messages about it."""

from __future__ import annotations

from collections import deque

from orchestra.logs.terminal_text import plain

_LONGEST_LINE = 500


class Tail:
    """Remembers the last `count` lines of what it is fed."""

    def __init__(self, count: int = 10) -> None:
        self._lines: deque[str] = deque(maxlen=count)
        self._unfinished = ""
        self._count = count

    def feed(self, text: str) -> None:
        """Take a piece of output; it need not end with a line."""
        *lines, rest = text.rsplit("\n", self._count + 1)
        if lines:
            # What stands before the last `count` lines falls out of the queue anyway.
            lines[0] = self._unfinished + lines[0] if "\n" not in lines[0] else lines[0].rpartition("\n")[2]
            self._lines.extend(plain(line)[-_LONGEST_LINE:] for line in lines)
            self._unfinished = ""
        self._unfinished = (self._unfinished + rest)[-_LONGEST_LINE:]

    @property
    def lines(self) -> tuple[str, ...]:
        """The last lines, oldest first; an unfinished one counts."""
        last = (plain(self._unfinished),) if self._unfinished else ()
        return (*self._lines, *last)[-self._count :]
