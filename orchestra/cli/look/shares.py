"""Who takes which pieces of work: what stands side by side goes to the same worker, and none is idle before the end."""

from __future__ import annotations

from collections import deque
from itertools import pairwise
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterable

_MOST: Final = 64  # pieces that are handed over at once
_BRIEF: Final = 0.1  # seconds: whoever is done so soon is handed twice as many


class Shares:
    """Pieces, told by their numbers, among workers, told by theirs.

    Each worker has a stretch of its own, so that it meets with one kind of work as long as there is of that. Whoever is
    done with his takes over half of what is left of the longest. How many pieces go over at once follows how long the
    last ones took: a message costs as much as a small piece, and what has gone over nobody else can take.
    """

    def __init__(self, pieces: int, workers: int) -> None:
        bounds = [pieces * number // workers for number in range(workers + 1)]
        self._stretches = [deque(range(first, last)) for first, last in pairwise(bounds)]
        self._sizes = [1] * workers
        self.left = pieces

    def take(self, worker: int) -> list[int]:
        """Return the pieces that a worker is to do next; none where all have been taken."""
        own = self._stretches[worker]
        if not own:
            longest = max(self._stretches, key=len)
            own.extend(reversed([longest.pop() for _ in range((len(longest) + 1) // 2)]))
        fair = 1 + self.left // (2 * len(self._stretches))
        count = min(self._sizes[worker], fair, len(own))
        self.left -= count
        return [own.popleft() for _ in range(count)]

    def took(self, worker: int, seconds: float) -> None:
        """Take note of how long a worker took for what it was given last."""
        size = self._sizes[worker]
        self._sizes[worker] = min(2 * size, _MOST) if seconds < _BRIEF else max(1, size // 2)

    def put_back(self, worker: int, pieces: Iterable[int]) -> None:
        """Let pieces be taken again."""
        again = list(pieces)
        self._stretches[worker].extendleft(reversed(again))
        self.left += len(again)
