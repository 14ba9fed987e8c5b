"""What a page of the tutorials says: the files to save, and what to type.

A block of code named in the words `NAME:` before it ("Save as `NAME`:") is a file. A block `console` is typed line by
line behind `$ `; what follows is what is seen, `...` standing for any part of a line or any lines. `console other` is typed in another
terminal, and goes on. `^C` ends a command that would go on.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

from markdown_it import MarkdownIt

if TYPE_CHECKING:
    from collections.abc import Iterator

_OF_OTHERS = "RTPS_TRANSPORT_SHM"
_SAVED = re.compile(r"[Ss]ave as `([^`]+)`")


class File(NamedTuple):
    """Something to save."""

    name: str
    text: str


class Command(NamedTuple):
    """Something to type. `seen` is what is seen then, `interrupted` whether Ctrl-C follows."""

    text: str
    seen: tuple[str, ...]
    interrupted: bool
    elsewhere: bool

    def fits(self, output: str) -> bool:
        """Tell whether this is what is to be seen."""
        pattern = "".join(map(_pattern, _plain("\n".join(self.seen)).splitlines()))
        return re.fullmatch(pattern, f"{_plain(output)}\n") is not None


def _pattern(line: str) -> str:
    """Return the expression for a line: `...` alone is any number of lines, else any part of one."""
    return r"(?:.*\n)*?" if line.strip() == "..." else ".*?".join(map(re.escape, line.split("..."))) + r"\n"


def _plain(text: str) -> str:
    """Return a text without what nobody sees, spaces at the end of lines and empty lines at the end, and without what
    Fast DDS says of shared memory that killed processes of others have left.
    """
    return "\n".join(line.rstrip() for line in text.splitlines() if _OF_OTHERS not in line).rstrip("\n")


def steps(text: str) -> Iterator[File | Command]:
    """Yield what a page asks for, in order. Raises `ValueError` for a block that is neither."""
    said = ""
    for token in MarkdownIt().parse(text):
        if token.type == "inline":
            said = token.content
        elif token.type == "fence":
            kind, _, more = token.info.partition(" ")
            saved = _SAVED.search(said)
            if kind == "console":
                yield from _commands(token.content, elsewhere=more == "other")
            elif saved:
                yield File(saved[1], token.content)
            elif more != "shown":
                raise ValueError(f"line {token.map[0] + 1 if token.map else 0}: nobody types or saves this")
            said = ""


def _commands(text: str, *, elsewhere: bool) -> Iterator[Command]:
    typed: list[list[str]] = []
    for line in text.splitlines():
        if line.startswith("$ "):
            typed.append([line[2:]])
        elif typed:
            typed[-1].append(line)
        else:
            raise ValueError(f"something is seen before anything is typed: {line}")
    for command, *seen in typed:
        interrupted = seen[-1:] == ["^C"]
        yield Command(command, tuple(seen[:-1] if interrupted else seen), interrupted, elsewhere)
