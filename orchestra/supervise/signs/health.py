"""Sign of life: a command exits with 0."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from orchestra.plan.conditions import Alive
    from orchestra.probes.protocol import Cancel, Result
    from orchestra.supervise.loop import Loop

_SHORTEST_PAUSE = 0.01


class Health:
    """Runs the command of `alive` every so often; as many failures in a row as it says are a hang.

    `silent` is told so; False says that this is no hang.
    """

    def __init__(
        self,
        loop: Loop,
        alive: Alive,
        run: Callable[[Sequence[str], float, Callable[[Result], None]], Cancel],
        silent: Callable[[str], bool],
    ) -> None:
        self._loop = loop
        self._alive = alive
        self._run = run
        self._silent = silent
        self._armed = False
        self._failures = 0
        self._begun = 0.0
        self._current: Cancel | None = None

    def begin(self, *, armed: bool) -> None:
        """Run it from now on; where it is not armed, its failures count from its first success on."""
        self._armed = armed
        self._failures = 0
        self._current = self._loop.call_later(self._alive.interval, self._try)

    def end(self) -> None:
        """Run it no longer."""
        if self._current:
            self._current.cancel()
            self._current = None

    def _try(self) -> None:
        self._begun = self._loop.clock()
        self._current = self._run(self._alive.command or (), self._alive.timeout, self._told)

    def _told(self, result: Result) -> None:
        pause = max(_SHORTEST_PAUSE, self._begun + self._alive.interval - self._loop.clock())
        self._current = self._loop.call_later(pause, self._try)
        if result.fault is None:
            self._armed = True
            self._failures = 0
            return
        self._failures += 1 if self._armed else 0
        if self._failures >= self._alive.failures:
            self._failures = 0
            times = f" {self._alive.failures} times in a row" if self._alive.failures > 1 else ""
            self._silent(f"its command failed{times}: {result.fault}")
