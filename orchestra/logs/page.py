"""Puts the output of several sources on one page: each line begins with the prefix of its source."""

from __future__ import annotations


class Page:
    """Composes text for a screen or a file. It remembers whose unfinished line stands at the end."""

    def __init__(self) -> None:
        self._open: object | None = None

    def compose(self, source: object, prefix: bytes, data: bytes, *, again: bool = False) -> bytes:
        """Return what to write for a piece of a source's output.

        A piece that continues the source's own unfinished line continues it here, or overwrites it where that begins
        `again`; the unfinished line of another is ended first.
        """
        if not data:
            return b""
        before = b"" if self._open is None or self._open == source else b"\n"
        first = prefix
        if self.continues(source):
            first = b"\r" + prefix if again else b""
        finished = data.endswith(b"\n")
        self._open = None if finished else source
        body = data.replace(b"\n", b"\n" + prefix)
        # The last end of a line has no line behind it.
        shown = memoryview(body)[: len(body) - len(prefix)] if finished else body
        return b"".join((before, first, shown))

    def continues(self, source: object) -> bool:
        """Tell whether the line at the end is an unfinished one of this source."""
        return self._open is not None and self._open == source

    def let_through(self, source: object, data: bytes) -> bytes:
        """Return what to write for output that is shown as it is, without prefixes."""
        before = b"" if self._open is None or self._open == source else b"\n"
        self._open = None if data.endswith(b"\n") else source
        return before + data

    def end(self) -> bytes:
        """Return what ends the page: a newline where a line is unfinished."""
        ending = b"" if self._open is None else b"\n"
        self._open = None
        return ending
