"""The lines of the files that problems point into."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

from orchestra.patterns import pattern

Sources: TypeAlias = Callable[[str, int], str | None]

_BREAK = pattern("\r\n|[\n\r\x85\u2028\u2029]")  # the breaks that YAML's parsers count


def from_files(given: dict[str, str] | None = None) -> Sources:
    """Return a function from a file and a 1-based line to its text, None where there is no such line.

    `given` holds the text of files that exist only in the caller's mind, such as the command line. Each file is read
    once; one that cannot be read has no lines, for the problem that names it says so.
    """
    read = {file: _lines(text) for file, text in (given or {}).items()}

    def line(file: str, number: int) -> str | None:
        if file not in read:
            read[file] = _read(Path(file))
        lines = read[file]
        return lines[number - 1] if 0 < number <= len(lines) else None

    return line


def _read(path: Path) -> list[str]:
    try:
        return _lines(path.read_bytes().decode("utf-8-sig", errors="replace"))
    except (OSError, ValueError):
        return []


def _lines(text: str) -> list[str]:
    return _BREAK.split(text)
