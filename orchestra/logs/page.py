"""Puts the output of several sources on one page: each line begins with the prefix of its source."""

from __future__ import annotations


class Page:
    """Composes text for a screen or a file. It remembers whose unfinished line stands at the end."""

    def __init__(self) -> None:
        self._open: object | None = None

    def compose(self, source: object, prefix: str, text: str, *, again: bool = False) -> str:
        """Return what to write for a piece of a source's output.

        A piece that continues the source's own unfinished line continues it here, or overwrites it where that begins
        `again`; the unfinished line of another is ended first.
        """
        if not text:
            return ""
        before = "" if self._open is None or self._open == source else "\n"
        first = prefix
        if self.continues(source):
            first = f"\r{prefix}" if again else ""
        finished = text.endswith("\n")
        body = text[:-1] if finished else text
        self._open = None if finished else source
        return before + first + body.replace("\n", "\n" + prefix) + ("\n" if finished else "")

    def continues(self, source: object) -> bool:
        """Tell whether the line at the end is an unfinished one of this source."""
        return self._open is not None and self._open == source

    def let_through(self, source: object, data: bytes) -> bytes:
        """Return what to write for output that is shown as it is, without prefixes."""
        before = b"" if self._open is None or self._open == source else b"\n"
        self._open = None if data.endswith(b"\n") else source
        return before + data

    def end(self) -> str:
        """Return what ends the page: a newline where a line is unfinished."""
        ending = "" if self._open is None else "\n"
        self._open = None
        return ending
