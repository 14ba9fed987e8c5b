"""The last lines of a process, for messages about it."""

from __future__ import annotations

from typing import Final

from orchestra.logs.terminal_text import plain_text

_LONGEST_LINE: Final = 500
# So many bytes are kept before what is older than the last lines is let go.
_KEPT: Final = 16384
# A character in UTF-8 has at most as many bytes.
_WIDEST: Final = 4


class Tail:
    """Remembers the last `count` lines of what it is fed; they are told apart when somebody wants to see them."""

    def __init__(self, count: int = 10) -> None:
        self._kept = bytearray()
        self._count = count
        self._most = _KEPT

    def feed(self, data: bytes) -> None:
        """Take a piece of output; it need not end with a line."""
        if data.count(b"\n", -_KEPT) > self._count:
            self._kept = bytearray(data[-_KEPT:])
            return
        self._kept += data
        if len(self._kept) > self._most:
            self._kept = bytearray(b"\n".join(self._last_lines()))
            # As much again may come, so that each byte is looked at a few times at most.
            self._most = 2 * len(self._kept) + _KEPT

    @property
    def lines(self) -> tuple[str, ...]:
        """The last lines, oldest first; an unfinished one counts."""
        *lines, last = (line.decode("utf-8", "surrogateescape") for line in self._last_lines())
        whole = [plain_text(line)[-_LONGEST_LINE:] for line in lines]
        if last:
            whole.append(plain_text(last[-_LONGEST_LINE:]))
        return tuple(whole[-self._count :])

    def _last_lines(self) -> list[bytes]:
        """Return the last lines, of each no more than can be shown; behind the last of them the unfinished one."""
        lines = self._kept.rsplit(b"\n", self._count + 1)[-self._count - 1 :]
        return [bytes(line[-_LONGEST_LINE * _WIDEST :]) for line in lines]
