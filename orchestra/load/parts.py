"""The parts of a text with substitutions, as they are gathered."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, Protocol

from orchestra.description.text import Words

if TYPE_CHECKING:
    import re
    from collections.abc import Callable

    from orchestra.description.text import Part
    from orchestra.location import Span

_UNESCAPED: Final = ("", "\n")


class Reading(Protocol):
    """A place in a text from which it is read on."""

    text: str
    at: int

    @property
    def spans(self) -> Callable[[int, int], Span]:
        """What gives the place of a stretch of the text."""

    @property
    def here(self) -> str:
        """The character to be read next, empty at the end."""

    def call(self, within: str, depth: int) -> tuple[Part, ...]:
        """Read a substitution."""


class Parts:
    """Gathers parts, adjoining characters into one."""

    __slots__ = ("_begin", "_characters", "_parts", "_reader")

    def __init__(self, reader: Reading) -> None:
        self._reader = reader
        self._parts: list[Part] = []
        self._characters: list[str] = []
        self._begin = reader.at

    def text(self, plain: re.Pattern[str]) -> None:
        """Take a run of plain characters, else the next one, or the one behind a backslash.

        A backslash at the very end is itself, and at the end of a line, as upstream's pattern for escapes has it.
        """
        reader = self._reader
        if match := plain.match(reader.text, reader.at):
            self._characters.append(match[0])
            reader.at = match.end()
            return
        if reader.here == "\\" and reader.text[reader.at + 1 : reader.at + 2] not in _UNESCAPED:
            reader.at += 1
        self._characters.append(reader.here)
        reader.at += 1

    def substitution(self, within: str, depth: int) -> None:
        """Take the substitution that begins here."""
        self._flush()
        self._parts.extend(self._reader.call(within, depth))
        self._begin = self._reader.at

    def finished(self) -> tuple[Part, ...]:
        """Return all parts."""
        self._flush()
        return tuple(self._parts)

    def _flush(self) -> None:
        if self._characters:
            span = self._reader.spans(self._begin, self._reader.at)
            self._parts.append(Words("".join(self._characters), span))
            self._characters.clear()
