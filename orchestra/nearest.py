"""What was probably meant: the nearest of the words that would have been right.

To look for it among many words takes long, and a file may have many words that are wrong: of each of a thousand
variables the name may be misspelt. So all that is looked at for one launch file has an end (`renew`), behind which
nothing is suggested any more but from among a few words.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import islice
from operator import itemgetter
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

_LEAST_LIKENESS = 0.6
_LIKENESS_OF_A_SLIP = 0.7
_CHARACTERS_OF_A_SLIP = 2  # more or less
_LIKENESS_OF_A_SWAP = 0.9  # two letters in each other's place
_LIKENESS_OF_A_SHORT_SWAP = 0.8
_LETTERS_OF_A_SHORT_WORD = 4
_FEW: Final = 64  # words to choose from, among which one is always looked for
_STEPS: Final = 1_000_000  # of about a microsecond, for all that is looked for among more words
_STEPS_OF_LETTERS: Final = 4
_STEPS_OF_A_RATIO: Final = 16

_left = [_STEPS]
_renewals = [0]


def renew() -> None:
    """Begin with another launch file, for which as much is looked at as for any."""
    _left[0] = _STEPS
    _renewals[0] += 1
    _nearest.cache_clear()
    _first_slip.cache_clear()


def may_look(steps: int) -> bool:
    """Return whether so many steps may be taken still to look for what was meant; then they are taken."""
    if _left[0] <= 0:
        return steps <= _FEW
    _left[0] -= steps
    return True


def renewals() -> int:
    """Return how many launch files have been begun with: what was seen for one may have changed for the next."""
    return _renewals[0]


def one_slip(word: str, candidates: Sequence[str]) -> str | None:
    """Return the first candidate from which one slip is all that tells the word apart, see `is_one_slip`."""
    if _left[0] <= 0 and len(candidates) > _FEW:
        return None
    return _first_slip(word, tuple(candidates))


@lru_cache(maxsize=32)  # the same variable is read in each of a thousand nodes
def _first_slip(word: str, candidates: tuple[str, ...]) -> str | None:
    alike = [other for other in candidates if -1 <= len(other) - len(word) <= 1]
    if len(candidates) > _FEW:
        _left[0] -= len(candidates) // _STEPS_OF_LETTERS + _STEPS_OF_LETTERS * len(alike)
    return next((other for other in alike if is_one_slip(word, other)), None)


def nearest(word: str, candidates: Iterable[str]) -> str | None:
    """Return the candidate most like the word, None where none is near. Case, `-` and `_` weigh nothing."""
    if _left[0] <= 0:
        candidates = tuple(islice(candidates, _FEW + 1))
        if len(candidates) > _FEW:
            return None
    return _nearest(word, tuple(sorted(set(candidates))))


@lru_cache(maxsize=32)  # the same slip is made in each of a thousand nodes
def _nearest(word: str, candidates: tuple[str, ...]) -> str | None:
    folded = _folded(word)
    bounds = _bounds(folded, word, candidates)
    best, best_likeness, ratios = [], _LEAST_LIKENESS, 0
    for bound, candidate in sorted(bounds, key=itemgetter(0), reverse=True):
        if bound < best_likeness:
            break  # so are all that follow
        ratios += 1
        likeness = _likeness(folded, _folded(candidate))
        if likeness > best_likeness:
            best, best_likeness = [candidate], likeness
        elif best and likeness == best_likeness:
            best.append(candidate)
    if len(candidates) > _FEW:
        _left[0] -= len(candidates) + _STEPS_OF_LETTERS * len(bounds) + _STEPS_OF_A_RATIO * ratios
    return _of_case(word, sorted(best))


def _of_case(word: str, alike: Sequence[str]) -> str | None:
    """Return the first of words that are as near, or what is but for the case that one and has more of the word's."""
    best = alike[0] if alike else None
    for candidate in alike[1:]:
        if best is not None and _same_case(word, candidate, best):
            best = candidate
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


def _bounds(folded: str, word: str, candidates: Iterable[str]) -> list[tuple[float, str]]:
    """Return the candidates that may be near, with what their likeness is at the most."""
    letters = {letter: folded.count(letter) for letter in folded}
    length, found = len(folded), []
    for candidate in candidates:
        other = _folded(candidate)
        both = length + len(other)
        # What `real_quick_ratio` would say, without looking at the letters.
        if candidate == word or 2 * min(length, len(other)) <= _LEAST_LIKENESS * both:
            continue
        # What `quick_ratio` would say, in a tenth of the time.
        common = sum([min(count, other.count(letter)) for letter, count in letters.items()])
        bound = 2.0 * common / both
        if bound > _LEAST_LIKENESS:
            found.append((bound, candidate))
    return found


def _likeness(word: str, candidate: str) -> float:
    """Return how much alike two words are; between short ones a single slip counts, and nothing that is less alike."""
    if "_" in word and sorted(word.split("_")) == sorted(candidate.split("_")):
        return _LIKENESS_OF_A_SWAP  # `scale_linear` of `linear_scale`
    short = min(len(word), len(candidate)) <= _LETTERS_OF_A_SHORT_WORD
    if len(word) == len(candidate) and _is_swapped(word, candidate):
        return _LIKENESS_OF_A_SHORT_SWAP if short else max(_LIKENESS_OF_A_SWAP, 1 - 1 / len(word))
    ratio = _ratio(word, candidate)
    framed = word[:2] == candidate[:2] and word[-1] == candidate[-1]  # `alfa` of `alpha`
    near = ratio >= _LIKENESS_OF_A_SLIP or framed or _one_slip(word, candidate) or word.startswith(candidate)
    return ratio if near or not short else 0.0
