"""What may stand at the cursor."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable


class Candidate(NamedTuple):
    """A word, or the beginning of one where `open`, and a few words about it."""

    word: str
    description: str = ""
    open: bool = False


def beginning_with(begun: str, candidates: Iterable[Candidate]) -> list[Candidate]:
    """Return the candidates that begin as the word at the cursor, each once, in their order."""
    found: dict[str, Candidate] = {}
    for candidate in candidates:
        if candidate.word.startswith(begun):
            found.setdefault(candidate.word, candidate)
    return list(found.values())
