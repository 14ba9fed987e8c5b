"""Normal random numbers one by one, drawn in blocks: a call of numpy's generator costs as much as a hundred numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

BLOCK = 600


class Draws:
    """The stream of normal numbers of a generator, which nobody else may use."""

    def __init__(self, chance: np.random.Generator) -> None:
        self._chance = chance
        self._block: list[float] = []
        self._at = 0

    def take(self, count: int) -> list[float]:
        """The next numbers; how they are asked for does not change the stream."""
        while self._at + count > len(self._block):
            self._block = self._block[self._at :] + self._chance.standard_normal(BLOCK).tolist()
            self._at = 0
        begin, self._at = self._at, self._at + count
        return self._block[begin : self._at]

    def skip(self, count: int) -> None:
        """Let the next numbers go."""
        if self._at + count > len(self._block):
            self.take(count)
        else:
            self._at += count
