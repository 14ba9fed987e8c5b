"""Whether one name is hardly anything but another one mistyped.

Stricter than `nearest`: names of nodes that belong together look alike (`front_lidar`, `rear_lidar`, `camera1`,
`camera2`), so a single word of a name may differ, by a letter or two.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Final

_SHORTEST: Final = 4  # below that, one letter makes another word
_SHORTEST_FOR_TWO: Final = 8
_NODE: Final = "node"  # the last word of many names, which means nothing: no other word is `nod` or `noe`


def is_typo(word: str, meant: str) -> bool:
    """Return whether `word` is `meant` mistyped: other case, an underscore more or less, a wrong letter in one word."""
    if word == meant:
        return False
    if _folded(word) == _folded(meant):
        return True
    if _digits(word) != _digits(meant):
        return False
    ones, others = word.lower().split("_"), meant.lower().split("_")
    if len(ones) != len(others):
        return _is_near("".join(ones), "".join(others))
    differing = [pair for pair in zip(ones, others, strict=True) if pair[0] != pair[1]]
    if len(differing) != 1:
        return False
    one, other = differing[0]
    return _is_near(one, other) or (_NODE in (one, other) and distance(one, other, 1) <= 1)


def distance(one: str, other: str, most: int) -> int:
    """Return how many letters are wrong, missing, too many or swapped; `most` and one where there are more."""
    if abs(len(one) - len(other)) > most:
        return most + 1
    before: list[int] = []
    row = list(range(len(other) + 1))
    for i, letter in enumerate(one, 1):
        above, row = row, [i]
        for j, its in enumerate(other, 1):
            cost = min(above[j] + 1, row[j - 1] + 1, above[j - 1] + (letter != its))
            if i > 1 and j > 1 and letter == other[j - 2] and one[i - 2] == its:
                cost = min(cost, before[j - 2] + 1)
            row.append(cost)
        before = above
    return min(row[-1], most + 1)


def _is_near(one: str, other: str) -> bool:
    shorter = min(len(one), len(other))
    if shorter < _SHORTEST:
        return False
    most = 2 if shorter >= _SHORTEST_FOR_TWO else 1
    return distance(one, other, most) <= most


@lru_cache(maxsize=4096)
def _folded(word: str) -> str:
    return word.lower().replace("_", "").replace("-", "")


@lru_cache(maxsize=4096)
def _digits(text: str) -> str:
    return "".join(character for character in text if character.isdigit())
