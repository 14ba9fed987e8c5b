"""Tries something again and again until it holds."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from orchestra.probes.protocol import Cancel, Site

# One attempt: tells, now or later, None where it holds and else what is wrong. Returns how to give it up.
Attempt: TypeAlias = Callable[["Site", Callable[[str | None], None]], "Cancel | None"]

# However short the interval is, there is room for everything else, in seconds.
_SHORTEST_PAUSE = 0.01


class Repeated:
    """A condition that has to be tried, every `interval` seconds, one attempt after the other."""

    looks_into_graph = False

    def __init__(self, words: str, attempt: Attempt, interval: float) -> None:
        self._words = words
        self._attempt = attempt
        self._interval = interval
        self._fault: str | None = None
        self._site: Site | None = None
        self._current: Cancel | None = None
        self._begun = 0.0

    @property
    def words(self) -> str:
        """What is awaited, and why it does not hold yet."""
        return f"{self._words} ({self._fault})" if self._fault else self._words

    def begin(self, site: Site, came: Callable[[], None]) -> None:
        """Try from now on."""
        self._site = site
        self._came = came
        self._current = site.loop.call_later(0.0, self._try)

    def end(self) -> None:
        """Try no longer."""
        self._site = None
        if self._current:
            self._current.cancel()
            self._current = None

    def _try(self) -> None:
        if self._site:
            self._begun = time.monotonic()
            self._current = None
            current = self._attempt(self._site, self._told)
            self._current = self._current or current  # the next attempt, where this one is over already

    def _told(self, fault: str | None) -> None:
        if self._site is None:
            return
        self._fault = fault
        if fault is None:
            self._site = self._current = None
            self._came()
            return
        pause = max(_SHORTEST_PAUSE, self._begun + self._interval - time.monotonic())
        self._current = self._site.loop.call_later(pause, self._try)
