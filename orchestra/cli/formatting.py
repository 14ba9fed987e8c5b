"""What `orchestra format` does with one file after another, and what it tells of them."""

from __future__ import annotations

import difflib
import sys
from enum import Enum, auto
from typing import TYPE_CHECKING

from orchestra.cli import boundary
from orchestra.cli.targets import kind_of
from orchestra.dataclass import dataclass
from orchestra.errors import Code, Problems
from orchestra.fields import field
from orchestra.formatting.formatted import formatted
from orchestra.formatting.refusal import NotFormatted
from orchestra.formatting.replacing import replace
from orchestra.load.encodings import UndecodableError, decoded
from orchestra.load.files import PYTHON
from orchestra.location import Location, displayed, point

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from orchestra.cli.targets import Kind

STANDARD_INPUT = "<stdin>"


class Showing(Enum):
    """What is done with a file that is not as it should be."""

    WRITTEN = auto()
    NAMES = auto()
    DIFFERENCE = auto()


@dataclass(slots=True)
class Formatting:
    """One call of the command, and what it has found so far."""

    width: int
    showing: Showing
    problems: Problems = field(default_factory=Problems)
    changed: int = 0
    unchanged: int = 0
    failed: int = 0
    in_python: int = 0

    def file(self, path: Path, kind: Kind) -> None:
        """Format one file, of a kind that is known."""
        shown = displayed(str(path))
        if path.suffix == PYTHON:
            self.in_python += 1
            return
        try:
            content = path.read_bytes()
        except OSError as error:
            message = f"cannot read {shown}: {error.strerror}"
            self.problems.error(Code.UNREADABLE_FILE, message, Location(point(shown)))
            return
        result = self._result(content, shown, lambda _text: kind)
        if result is None:
            return
        if result == content:
            self.unchanged += 1
        elif self.showing is not Showing.WRITTEN or self._write(path, result):
            self.changed += 1
            self._show(content, result, shown)

    def stream(self, content: bytes, name: str | None) -> int:
        """Format standard input to standard output, as the file of a name; return the exit status."""
        shown = name or STANDARD_INPUT
        result = self._result(content, shown, lambda text: kind_of(name or "x.yaml", text) or "launch")
        if result is None:
            boundary.show_problems(
                self.problems.ordered, "text", sys.stderr, texts={shown: content.decode("utf-8", "replace")}
            )
            return boundary.MISTAKE
        if self.showing is Showing.WRITTEN:
            sys.stdout.buffer.write(result)
            return boundary.OK
        if result != content:
            self._show(content, result, shown)
        return boundary.FAILED if result != content else boundary.OK

    def status(self) -> int:
        """Return the exit status after all files."""
        if self.problems.errors:
            return boundary.MISTAKE
        wanting = self.changed and self.showing is not Showing.WRITTEN
        return boundary.FAILED if wanting or self.failed else boundary.OK

    def summary(self) -> str:
        """Return how many files were, or would be, changed."""
        verb = "formatted" if self.showing is Showing.WRITTEN else "would be formatted"
        told = []
        if self.changed:
            told.append(f"{_files(self.changed)} {verb}")
        if self.unchanged or not (self.changed or self.in_python):
            told.append(f"{_files(self.unchanged)} left unchanged")
        if not told:
            told.append(
                f"{_files(self.in_python)} in Python left alone: YAML, XML and parameter files are formatted"
            )
        return ", ".join(told) + "\n"

    def _result(self, content: bytes, shown: str, kind: Callable[[str], Kind]) -> bytes | None:
        """Return a file as it should be, None for one that cannot be read (which has been reported)."""
        try:
            return formatted(content, shown, kind, self.problems, self.width)
        except NotFormatted as reason:
            sys.stderr.write(f"{shown} is left as it is: {reason}\n")
            return content

    def _write(self, path: Path, content: bytes) -> bool:
        try:
            replace(path, content)
        except OSError as error:
            sys.stderr.write(f"error: cannot write {displayed(str(path))}: {error.strerror}\n")
            self.failed += 1
            return False
        return True

    def _show(self, before: bytes, after: bytes, shown: str) -> None:
        if self.showing is Showing.DIFFERENCE:
            sys.stdout.write("".join(_difference(before, after, shown)))
        elif self.showing is Showing.NAMES:
            sys.stdout.write(f"{shown}\n")


def _difference(before: bytes, after: bytes, shown: str) -> list[str]:
    """Return the lines of a unified difference, as `diff -u` prints them."""
    found = difflib.unified_diff(_lines(before), _lines(after), shown, shown)
    return [line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n" for line in found]


def _lines(content: bytes) -> list[str]:
    """Return the lines of a text, their breaks as they are: only a line feed ends one."""
    try:
        text = decoded(content)
    except UndecodableError:
        text = content.decode("utf-8", "replace")
    lines = text.split("\n")
    return [f"{line}\n" for line in lines[:-1]] + ([lines[-1]] if lines[-1] else [])


def _files(number: int) -> str:
    return f"{number} file{'s' * (number != 1)}"
