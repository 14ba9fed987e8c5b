"""A shell's question, and the answer as its hook reads it: one candidate a line."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Final

from orchestra.cli.completing.command_line import candidates
from orchestra.cli.completing.shell_words import split_line, written
from orchestra.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence


def answer(shell: str, question: Sequence[str]) -> str:
    """Return the answer to the question of a shell's hook. Raises `UsageError` for what no hook asks.

    A word with a line break in it cannot be told, and is left out.
    """
    if shell not in _ANSWERS:
        raise UsageError(f"no shell '{shell}' is known")
    return "".join(f"{line}\n" for line in _ANSWERS[shell](question) if "\n" not in line)


def _bash(question: Sequence[str]) -> list[str]:
    """Answer the cursor's place in bytes, the line and `COMP_WORDBREAKS` with what readline is to insert."""
    if len(question) != 3 or not question[0].isdecimal():  # noqa: PLR2004 - these three
        raise UsageError("bash asks with COMP_POINT, COMP_LINE and COMP_WORDBREAKS")
    point, text, breaks = question
    line = split_line(os.fsdecode(os.fsencode(text)[: int(point)]), breaks)
    found = candidates(line.before[1:], line.begun)
    alone = len(found) == 1
    return [written(item.word, line, finished=alone and not item.open) for item in found]


def _words(question: Sequence[str]) -> list[str]:
    """Answer the words up to the cursor, the program's name left out, with words, a tab, and descriptions."""
    *before, begun = question or [""]
    return [f"{item.word}\t{' '.join(item.description.split())}" for item in candidates(before, begun)]


_ANSWERS: Final[dict[str, Callable[[Sequence[str]], list[str]]]] = {
    "bash": _bash,
    "zsh": _words,
    "fish": _words,
}
