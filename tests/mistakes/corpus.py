"""Broken files with what is wrong in them marked in place, as text files hold them.

A case begins with `## title`. `⟪wrong⟫` marks what a problem must span, `⟪wrong⇒right⟫` also what must be suggested,
`⟪?wrong⟫` says that it is a warning, `⟪??lacking⟫` that it is a note. `$ WORDS` are those of the command line, `@ WORDS` are told to the test. Files
begin with `=== name`; the first one needs no name where the test gives it one. `chain: FILE:LINE ...` says by which
includes a file is reached, innermost first.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from orchestra.errors import Severity
from orchestra.location import Span
from orchestra.resolve.command_line import COMMAND_LINE

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

_MARK = re.compile(r"⟪(\?{0,2})(.*?)(?:⇒(.*?))?⟫", re.DOTALL)
_WEIGHTS = {"": Severity.ERROR, "?": Severity.WARNING, "??": Severity.NOTE}
_FILE = "=== "
_CHAIN = "chain: "


@dataclass(frozen=True, slots=True)
class Mistake:
    """Where a problem must be told, and what must be suggested."""

    span: Span
    severity: Severity
    suggestion: str | None


@dataclass(slots=True)
class Case:
    """Files by name, the first of them the main one; words of a command line; what is wrong."""

    title: str
    files: dict[str, str] = field(default_factory=dict)
    words: tuple[str, ...] = ()
    told: frozenset[str] = frozenset()
    mistakes: list[Mistake] = field(default_factory=list)
    chains: dict[str, tuple[str, ...]] = field(default_factory=dict)

    @property
    def main(self) -> str:
        """The name of the file that is checked."""
        return next(iter(self.files))

    def add(self, name: str, marked: str) -> None:
        """Add a file whose mistakes are marked."""
        self.files[name] = self.unmarked(name, marked)

    def unmarked(self, name: str, marked: str) -> str:
        """Return a text without its marks, which are noted as mistakes in the file of this name."""
        text, at = "", 0
        for found in _MARK.finditer(marked):
            weight, wrong, right = found.groups()
            text += marked[at : found.start()]
            begin = _place(text)
            text += wrong
            severity = _WEIGHTS[weight]
            self.mistakes.append(Mistake(Span(name, *begin, *_place(text)), severity, right))
            at = found.end()
        return text + marked[at:]


def cases(path: Path, main: str) -> Iterator[Case]:
    """Yield the cases of a file; `main` names the file of a case that has no name."""
    _, *blocks = re.split(r"^## ", path.read_text("utf-8"), flags=re.MULTILINE)
    for block in blocks:
        yield _case(block, main)


def _case(block: str, main: str) -> Case:
    title, _, rest = block.partition("\n")
    case = Case(title)
    lines: dict[str, list[str]] = {}
    name = main
    for line in rest.rstrip("\n").split("\n"):
        if line.startswith("$ "):
            case.words = tuple(case.unmarked(COMMAND_LINE, line.removeprefix("$ ")).split())
        elif line.startswith("@ "):
            case.told = frozenset(line.removeprefix("@ ").split())
        elif line.startswith(_FILE):
            name = line.removeprefix(_FILE)
        elif line.startswith(_CHAIN):
            case.chains[name] = tuple(line.removeprefix(_CHAIN).split())
        else:
            lines.setdefault(name, []).append(line)
    for file, content in lines.items():
        case.add(file, "\n".join([*content, ""]))
    return case


def _place(text: str) -> tuple[int, int]:
    return text.count("\n") + 1, len(text) - text.rfind("\n")
