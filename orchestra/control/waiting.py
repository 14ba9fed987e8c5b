"""Requests whose answer comes later: when the processes that they concern have come to rest."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from orchestra.supervise.process.life import Phase

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from orchestra.supervise.loop import Loop
    from orchestra.supervise.operation import Operation, Standing

_MOVING = frozenset({Phase.WAITING.value, Phase.STARTING.value, Phase.STOPPING.value})


def at_rest(standing: Standing) -> bool:
    """Tell whether nothing happens to a process by itself: it is ready, has ended, or waits to be tried again."""
    if standing.phase == Phase.RUNNING.value:
        return standing.awaited is None
    return standing.phase not in _MOVING


class _Wait(NamedTuple):
    processes: frozenset[str]
    answer: Callable[[dict[str, Standing] | None], None]


class Waiting:
    """Looks, whenever something has happened, which requests can be answered; not once more than that."""

    def __init__(self, loop: Loop, operation: Operation) -> None:
        self._loop = loop
        self._operation = operation
        self._waits: list[_Wait] = []
        self._looking = False

    def until_rest(
        self, processes: Iterable[str], answer: Callable[[dict[str, Standing] | None], None]
    ) -> Callable[[], None]:
        """Call `answer` once with how the processes stand when all are at rest, None where the run is over before.

        What is returned takes it back.
        """
        wait = _Wait(frozenset(processes), answer)
        self._waits.append(wait)
        self.happened()

        def forget() -> None:
            if wait in self._waits:
                self._waits.remove(wait)

        return forget

    def happened(self) -> None:
        """Something has happened: look when it is done."""
        if self._waits and not self._looking:
            self._looking = True
            self._loop.call_later(0.0, self._look)

    def end(self) -> None:
        """Nothing will happen any more."""
        waits, self._waits = self._waits, []
        for wait in waits:
            wait.answer(None)

    def _look(self) -> None:
        self._looking = False
        if not self._waits:
            return
        standings = {standing.id: standing for standing in self._operation.processes()}
        resting = {name for name, standing in standings.items() if at_rest(standing)}
        done = [wait for wait in self._waits if wait.processes <= resting]
        self._waits = [wait for wait in self._waits if wait not in done]
        for wait in done:
            wait.answer({name: standings[name] for name in standings if name in wait.processes})
