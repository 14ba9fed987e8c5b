"""Where the keys and values of a TOML text stand: `tomllib` reads it, but does not tell.

Only texts that `tomllib` accepts are looked through, so that what stands here need not find fault with anything.
"""

from __future__ import annotations

import re
import tomllib
from typing import TYPE_CHECKING, Final, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.location import Span

if TYPE_CHECKING:
    from collections.abc import Generator, Iterator

Path: TypeAlias = tuple[str | int, ...]

_SPACE: Final = re.compile(r"(?:[ \t\r\n]|#[^\n]*)*")
_STRING: Final = re.compile(
    r'"""(?:\\.|[^\\])*?"{3,5}|\'\'\'.*?\'{3,5}|"(?:\\.|[^"\\\n])*"|\'[^\'\n]*\'', re.DOTALL
)
_BARE: Final = re.compile(r"[A-Za-z0-9_-]+")
_DOT: Final = re.compile(r"[ \t]*\.[ \t]*")
_PLAIN: Final = re.compile(r"[^,\]}#\n]*[^,\]}#\s]")
_FAULT: Final = re.compile(r" \((?:at line (\d+), column (\d+)|at end of document)\)$")


@dataclass(frozen=True, slots=True)
class Place:
    """Where a key and its value stand."""

    key: Span
    value: Span


def fault(error: tomllib.TOMLDecodeError, text: str, file: str) -> tuple[str, Span]:
    """Return what is wrong with a text that is no TOML, and where."""
    message = str(error)
    found = _FAULT.search(message)
    line, column = (int(found[1]), int(found[2])) if found and found[1] else _end(text)
    reason = _FAULT.sub("", message)
    return reason[:1].lower() + reason[1:], Span(file, line, column, line, column)


def places(text: str, file: str) -> dict[Path, Place]:
    """Return the places of all keys, and of the items of arrays, by the way to them."""
    return dict(_Scanner(text, file).statements())


def _end(text: str) -> tuple[int, int]:
    return text.count("\n") + 1, len(text) - text.rfind("\n")


@dataclass(slots=True)
class _Scanner:
    text: str
    file: str
    at: int = 0
    tables: dict[Path, int] = field(default_factory=dict)

    def statements(self) -> Iterator[tuple[Path, Place]]:
        table: Path = ()
        while self._space() < len(self.text):
            if self.text.startswith("[", self.at):
                table = yield from self._header()
            else:
                yield from self._pair(table)

    def _header(self) -> Generator[tuple[Path, Place], None, Path]:
        begin, many = self.at, self.text.startswith("[[", self.at)
        self.at += 1 + many
        self._space()
        names, span = self._key()
        path = self._resolved(names[:-1])
        path = (*path, names[-1])
        if many:
            number = self.tables[path] = self.tables.get(path, -1) + 1
            path = (*path, number)
        self.at = self.text.index("]", self.at) + 1 + many
        yield path, Place(span, self._span(begin, self.at))
        return path

    def _resolved(self, names: tuple[str, ...]) -> Path:
        """Return the way to a table: of an array of tables the last one is meant."""
        path: Path = ()
        for name in names:
            path = (*path, name)
            if path in self.tables:
                path = (*path, self.tables[path])
        return path

    def _pair(self, table: Path) -> Iterator[tuple[Path, Place]]:
        names, key = self._key()
        self.at = self.text.index("=", self.at) + 1
        self._space()
        path, begin = (*table, *names), self.at
        yield from self._value(path)
        yield path, Place(key, self._span(begin, self.at))

    def _key(self) -> tuple[tuple[str, ...], Span]:
        """Read a key with dots; the span is that of its last part."""
        names: list[str] = []
        while True:
            found = _STRING.match(self.text, self.at) or _BARE.match(self.text, self.at)
            if found is None:
                raise AssertionError("tomllib has read a key here")
            quoted = found.group()[0] in "\"'"
            names.append(tomllib.loads(f"k={found.group()}")["k"] if quoted else found.group())
            self.at = found.end()
            dot = _DOT.match(self.text, self.at)
            if dot is None:
                return tuple(names), self._span(*found.span())
            self.at = dot.end()

    def _value(self, path: Path) -> Iterator[tuple[Path, Place]]:
        if self.text.startswith("[", self.at):
            yield from self._array(path)
        elif self.text.startswith("{", self.at):
            self.at += 1
            while self._next("}"):
                yield from self._pair(path)
        else:
            found = _STRING.match(self.text, self.at) or _PLAIN.match(self.text, self.at)
            self.at = found.end() if found else self.at

    def _array(self, path: Path) -> Iterator[tuple[Path, Place]]:
        self.at += 1
        number = 0
        while self._next("]"):
            begin = self.at
            yield from self._value((*path, number))
            span = self._span(begin, self.at)
            yield (*path, number), Place(span, span)
            number += 1

    def _next(self, end: str) -> bool:
        """Go to the next item; false where the end is, which is passed."""
        self._space()
        if self.text.startswith(",", self.at):
            self.at += 1
            self._space()
        if self.text.startswith(end, self.at):
            self.at += 1
            return False
        return True

    def _space(self) -> int:
        found = _SPACE.match(self.text, self.at)
        self.at = found.end() if found else self.at
        return self.at

    def _span(self, begin: int, end: int) -> Span:
        return Span(self.file, *self._position(begin), *self._position(end))

    def _position(self, offset: int) -> tuple[int, int]:
        return self.text.count("\n", 0, offset) + 1, offset - self.text.rfind("\n", 0, offset)
