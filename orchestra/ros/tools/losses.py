"""How many messages of a topic have not come, by the numbers that publishers give them.

The middleware tells of what was lost on the way. It does not tell of what has come and had to make room for later
messages, because this process was busy, as where it writes to a terminal that is slow. In the numbers both are seen.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable


class Losses:
    """What is lost of one topic: `publishers` returns the identities of those who publish now.

    With a message comes its number, but not whose it is. So only a number that nobody can begin with counts: where all
    publishers that ever were have been heard. With several of them less may be told than was lost, but never more.
    """

    def __init__(
        self, publishers: Callable[[], Iterable[bytes]], tell: Callable[[int, int], None] | None
    ) -> None:
        self._publishers = publishers
        self._tell = tell
        self._known: set[bytes] = set()
        self._lasts: set[int] = set()
        self._missing = self._unheard = self._told = 0

    def number(self, number: int | None) -> None:
        """Take the number of the next message; none where the middleware gives none."""
        if number is None or self._tell is None:
            return
        if number - 1 in self._lasts:
            self._lasts.remove(number - 1)
        else:
            self._known.update(self._publishers())
            if len(self._lasts) >= len(self._known) and number > min(self._lasts, default=number):
                last = max(one for one in self._lasts if one < number)
                self._lasts.remove(last)
                self._missing += number - last - 1
        self._lasts.add(number)
        self._told_of(self._missing)

    def unheard(self, count: int) -> None:
        """Take how many more the middleware could not deliver: some of those that the numbers lack."""
        self._unheard += count
        self._told_of(self._unheard)

    def _told_of(self, total: int) -> None:
        if self._tell is not None and total > self._told:
            more, self._told = total - self._told, total
            self._tell(more, total)
