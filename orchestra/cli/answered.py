"""What `orchestra plan` has answered before, while the same words would be answered alike: see `remembered`."""

from __future__ import annotations

import os
import sys
from contextlib import nullcontext
from typing import TYPE_CHECKING

from orchestra.cli.colour import wanted
from orchestra.cli.remembered import remembered

if TYPE_CHECKING:
    from collections.abc import Sequence
    from contextlib import AbstractContextManager

    from orchestra.cli.remembering import Memory


def again(words: Sequence[str]) -> bool:
    """Give the answer that is kept for the words behind `plan`; tell whether there is one that still holds."""
    found = remembered(_name(words))
    if found is None:
        return False
    give(found.document, found.told)
    return True


def give(answer: bytes, told: str) -> None:
    """Write what is told to standard error, and the answer to standard output."""
    sys.stderr.write(told)
    sys.stderr.flush()
    sys.stdout.flush()
    sys.stdout.buffer.write(answer)


class Watch:
    """Watches an answer come about, and keeps it. Watches nothing where `words` is None: it is not to be kept."""

    def __init__(self, words: Sequence[str] | None) -> None:
        self._kept: Memory | None = None
        if words is not None:
            # Heavy, and without use where the answer was kept.
            from orchestra.cli.remembering import memory  # noqa: PLC0415

            self._kept = memory(_name(words))

    def watching(self) -> AbstractContextManager[None]:
        """Record everything that is looked at meanwhile."""
        return self._kept.watching() if self._kept else nullcontext()

    def keep(self, answer: bytes, told: str) -> None:
        """Keep what was written, for the next time. Does nothing where that cannot be."""
        written = self._kept.keep(answer, told) if self._kept else None
        if written:
            sys.stdout.flush()  # before anything else is done
            written()


def _name(words: Sequence[str]) -> tuple[str, ...]:
    """Return the words of the command, and whether it paints what it writes."""
    painted = [repr(wanted(stream, os.environ)) for stream in (sys.stdout, sys.stderr)]
    return ("plan", *words, *painted)
