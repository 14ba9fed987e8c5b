"""What was probably meant: the nearest of the words that would have been right."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

_LEAST_LIKENESS = 0.6
_LIKENESS_OF_A_SLIP = 0.7
_CHARACTERS_OF_A_SLIP = 2  # more or less
_LIKENESS_OF_A_SWAP = 0.9  # two letters in each other's place
_LIKENESS_OF_A_SHORT_SWAP = 0.8
_LETTERS_OF_A_SHORT_WORD = 4


def nearest(word: str, candidates: Iterable[str]) -> str | None:
    """Return the candidate most like the word, None where none is near. Case, `-` and `_` weigh nothing."""
    return _nearest(word, tuple(sorted(set(candidates))))


@lru_cache(maxsize=32)  # the same slip is made in each of a thousand nodes
def _nearest(word: str, candidates: tuple[str, ...]) -> str | None:
    folded = _folded(word)
    letters = {letter: folded.count(letter) for letter in folded}
    best, best_likeness = None, _LEAST_LIKENESS
    for candidate in candidates:
        if candidate == word:
            continue
        likeness = _likeness(folded, _folded(candidate), letters)
        if likeness > best_likeness or (
            best and likeness == best_likeness and _same_case(word, candidate, best)
        ):
            best, best_likeness = candidate, likeness
    return best


def _same_case(word: str, candidate: str, best: str) -> bool:
    """Return whether a candidate that is but for the case the best one has more of the word's letters as they are."""
    if _folded(candidate) != _folded(best):
        return False
    ours, others = (_ratio(word, other) for other in (candidate, best))
    return ours > others


def is_slip(word: str, meant: str) -> bool:
    """Return whether the word is hardly anything but a slip of the keys: `robot1` is none of `robot2`."""
    if abs(len(word) - len(meant)) > _CHARACTERS_OF_A_SLIP or _digits(word) != _digits(meant):
        return False
    one, other = _folded(word), _folded(meant)
    likeness = _ratio(one, other)
    return likeness >= _LIKENESS_OF_A_SLIP or _is_swapped(one, other)


def is_one_slip(word: str, meant: str) -> bool:
    """Return whether one slip is all that tells two words apart, and neither is a word of its own.

    Two letters are in each other's place, or one after the first is wrong, missing or too many. `sockets` is no slip
    for `socket`, nor `map` for `mcap`, nor `pose_x` for `pose_y`.
    """
    one, other = _folded(word), _folded(meant)
    if one == other or _is_swapped(one, other):
        return True
    if _differ_in_a_name(one, other):
        return False
    short = min(len(one), len(other)) < _LETTERS_OF_A_SHORT_WORD
    plural = one == f"{other}s" or (other == f"{one}s" and not other.endswith("ss"))
    if short or plural or one[0] != other[0] or _digits(word) != _digits(meant):
        return False
    return _one_slip(one, other)


def _ratio(one: str, other: str) -> float:
    from difflib import SequenceMatcher  # noqa: PLC0415 - slow, and most launch files have no slips

    return SequenceMatcher(None, one, other, autojunk=False).ratio()


def _digits(text: str) -> str:
    return "".join(character for character in text if character.isdigit())


def _is_swapped(word: str, other: str) -> bool:
    """Return whether two neighbouring letters have changed places."""
    return len(word) == len(other) and _one_slip(word, other) and sorted(word) == sorted(other)


def _one_slip(word: str, other: str) -> bool:
    """Return whether a letter too many, too few, wrong or in its neighbour's place is the difference."""
    same = next((at for at, (one, two) in enumerate(zip(word, other, strict=False)) if one != two), None)
    if same is None:
        return abs(len(word) - len(other)) == 1
    one, two = word[same:], other[same:]
    return one[2:] == two[2:] if one[:2] == two[1::-1] else two[1:] in (one, one[1:]) or one[1:] == two


def _differ_in_a_name(word: str, other: str) -> bool:
    """Return whether all that tells two words apart is a letter that stands alone in both."""
    if len(word) != len(other):
        return False
    at = next((at for at, (one, two) in enumerate(zip(word, other, strict=True)) if one != two), 0)
    around = word[max(at - 1, 0) : at] + word[at + 1 : at + 2]
    return word[at + 1 :] == other[at + 1 :] and not any(map(str.isalnum, around))


def _folded(word: str) -> str:
    return word.lower().replace("-", "_")


def _likeness(word: str, candidate: str, letters: dict[str, int]) -> float:
    """Return how much alike two words are; between short ones a single slip counts, and nothing that is less alike.

    `letters` are those of the word, with how often each stands in it.
    """
    if 2 * min(len(word), len(candidate)) <= _LEAST_LIKENESS * (len(word) + len(candidate)):
        return 0.0  # what `real_quick_ratio` would say, without looking at the letters
    short = min(len(word), len(candidate)) <= _LETTERS_OF_A_SHORT_WORD
    if len(word) == len(candidate) and _is_swapped(word, candidate):
        return _LIKENESS_OF_A_SHORT_SWAP if short else max(_LIKENESS_OF_A_SWAP, 1 - 1 / len(word))
    common = sum([min(count, candidate.count(letter)) for letter, count in letters.items()])
    if 2.0 * common / (len(word) + len(candidate)) <= _LEAST_LIKENESS:
        return 0.0  # what `quick_ratio` would say, in a tenth of the time
    ratio = _ratio(word, candidate)
    framed = word[:2] == candidate[:2] and word[-1] == candidate[-1]  # `alfa` of `alpha`
    near = ratio >= _LIKENESS_OF_A_SLIP or framed or _one_slip(word, candidate) or word.startswith(candidate)
    return ratio if near or not short else 0.0
