"""What was probably meant: the nearest of the words that would have been right."""

from __future__ import annotations

from difflib import SequenceMatcher
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

_LEAST_LIKENESS = 0.6
_LIKENESS_OF_A_SLIP = 0.7
_CHARACTERS_OF_A_SLIP = 2  # more or less


def nearest(word: str, candidates: Iterable[str]) -> str | None:
    """Return the candidate most like the word, None where none is near. Case, `-` and `_` weigh nothing."""
    folded = _folded(word)
    best, best_likeness = None, _LEAST_LIKENESS
    for candidate in sorted(set(candidates)):
        if candidate == word:
            continue
        likeness = _likeness(folded, _folded(candidate))
        if likeness > best_likeness:
            best, best_likeness = candidate, likeness
    return best


def is_slip(word: str, meant: str) -> bool:
    """Return whether the word is hardly anything but a slip of the keys: `robot1` is none of `robot2`."""
    if abs(len(word) - len(meant)) > _CHARACTERS_OF_A_SLIP or _digits(word) != _digits(meant):
        return False
    return SequenceMatcher(None, _folded(word), _folded(meant), autojunk=False).ratio() >= _LIKENESS_OF_A_SLIP


def _digits(text: str) -> str:
    return "".join(character for character in text if character.isdigit())


def _folded(word: str) -> str:
    return word.lower().replace("-", "_")


def _likeness(word: str, candidate: str) -> float:
    if 2 * min(len(word), len(candidate)) <= _LEAST_LIKENESS * (len(word) + len(candidate)):
        return 0.0  # what `real_quick_ratio` would say, without looking at the letters
    matcher = SequenceMatcher(None, word, candidate, autojunk=False)
    if matcher.quick_ratio() <= _LEAST_LIKENESS:
        return 0.0
    return matcher.ratio()
