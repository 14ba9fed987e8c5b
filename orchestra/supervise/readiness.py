"""Looks out for the readiness condition of one process, run by run."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.probes.table import probe_for
from orchestra.supervise import life

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.plan.model import Process
    from orchestra.probes.protocol import Probe
    from orchestra.supervise.loop import Timer
    from orchestra.supervise.surroundings import Surroundings


class Readiness:
    """Tells `handle` what becomes of the condition, and `impossible` why nobody can tell."""

    def __init__(
        self,
        process: Process,
        surroundings: Surroundings,
        handle: Callable[[life.Event], None],
        impossible: Callable[[str], None],
    ) -> None:
        self._process = process
        self._around = surroundings
        self._handle = handle
        self._impossible = impossible
        self._probe: Probe | None = None
        self._timer: Timer | None = None

    @property
    def words(self) -> str:
        """What is awaited."""
        return probe_for(self._process.ready).words if self._process.ready else "its start"

    @property
    def looks_into_graph(self) -> bool:
        """Whether the observer is needed for it."""
        return self._process.ready is not None and probe_for(self._process.ready).request is not None

    def begin(self, timeout: float | None) -> None:
        """Look out from now on, for `timeout` seconds; None for ever."""
        if self._process.ready is None:
            return
        self._probe = probe_for(self._process.ready)
        if timeout is not None:
            self._timer = self._around.loop.call_later(timeout, lambda: self._handle(life.ReadyExpired()))
        if self._probe.request:
            environment = self._around.environment(self._process)
            self._around.observers.watch(self._process.id, self._probe.request, environment, self._observed)

    def end(self) -> None:
        """Look out no longer."""
        self._probe = None
        if self._timer:
            self._timer.cancel()
        self._around.observers.forget(self._process.id)

    def read(self, stream: str, text: str) -> None:
        """Take a piece of the process's output."""
        if self._probe and self._probe.read(stream, text):
            self._handle(life.Satisfied())

    def _observed(self, problem: str | None) -> None:
        if problem is None:
            self._handle(life.Satisfied())
        else:
            self._impossible(problem)
