"""Looks out for the readiness conditions of one process, run by run: all of them have to come about."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from orchestra.logs.names import shown
from orchestra.supervise.process import life
from orchestra.supervise.process.spec import Spec

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from orchestra.plan.conditions import Ready
    from orchestra.plan.model import Process
    from orchestra.probes.protocol import Cancel, Probe, Request, Result, Site
    from orchestra.supervise.loop import Timer
    from orchestra.supervise.signs.notification import Notices
    from orchestra.supervise.surroundings import Surroundings


class Readiness:
    """Tells `handle` what becomes of the conditions, and `impossible` why nobody can tell."""

    def __init__(
        self,
        process: Process,
        surroundings: Surroundings,
        notices: Notices,
        handle: Callable[[life.Event], None],
        impossible: Callable[[str], None],
    ) -> None:
        self._process = process
        self._around = surroundings
        self._notices = notices
        self._handle = handle
        self._impossible = impossible
        self._missing: dict[str, Probe] = _probes(process.ready) if process.ready else {}
        self._needs_observer = any(probe.looks_into_graph for probe in self._missing.values())
        self._waiting = False
        self._listeners: list[Callable[[str, str], None]] = []
        self._timer: Timer | None = None
        notices.on("EXTEND_TIMEOUT_USEC", self._extend)

    @property
    def words(self) -> str:
        """What is awaited, of which what has come about is no part any more."""
        *first, last = [probe.words for probe in self._missing.values()] or ["its start"]
        return f"{', '.join(first)} and {last}" if first else last

    @property
    def looks_into_graph(self) -> bool:
        """Whether the observer is needed for it, now or with the next start."""
        if self._waiting:
            return any(probe.looks_into_graph for probe in self._missing.values())
        return self._needs_observer

    def begin(self, timeout: float | None) -> None:
        """Look out from now on, for `timeout` seconds; None for ever."""
        if self._process.ready is None:
            return
        self._waiting = True
        self._missing = _probes(self._process.ready)
        self._around.journal.say(f"waiting for {shown(self._process.id)}: {self.words}")
        if timeout is not None:
            self._set_timer(timeout)
        for key, probe in [*self._missing.items()]:
            probe.begin(self._site(key), partial(self._came, key))

    def end(self) -> None:
        """Look out no longer; what has not come about by now is kept for messages."""
        self._waiting = False
        self._listeners.clear()
        if self._timer:
            self._timer.cancel()
        for probe in self._missing.values():
            probe.end()

    def read(self, stream: str, data: bytes) -> None:
        """Take a piece of the process's output."""
        if self._listeners:
            text = data.decode("utf-8", "surrogateescape")
            for listener in [*self._listeners]:
                listener(stream, text)

    def _came(self, key: str) -> None:
        probe = self._missing.pop(key, None) if self._waiting else None
        if probe is None:
            return
        probe.end()
        if not self._missing:
            self._handle(life.Satisfied())

    def _set_timer(self, delay: float) -> None:
        if self._timer:
            self._timer.cancel()
        self._timer = self._around.loop.call_later(delay, lambda: self._handle(life.ReadyExpired()))

    def _extend(self, value: str) -> None:
        """The process wants so many microseconds from now on, at least (sd_notify(3))."""
        from orchestra.supervise.signs.notification import seconds  # noqa: PLC0415 - few processes notify

        wanted = seconds(value)
        if self._waiting and self._timer and wanted and wanted > self._timer.due - self._around.loop.clock():
            self._set_timer(wanted)

    def _site(self, key: str) -> Site:
        from orchestra.probes.protocol import Site  # noqa: PLC0415 - as for the probes

        return Site(
            loop=self._around.loop,
            folder=self._process.cwd,
            run=partial(run_beside, self._process, self._around),
            watch=partial(self._watch, key),
            on_output=self._listeners.append,
            on_notice=partial(self._on_notice, key),
            impossible=self._impossible,
        )

    def _watch(self, key: str, request: Request, answer: Callable[[str | None], None]) -> Cancel:
        name = f"ready {key} {self._process.id}"
        observers = self._around.observers
        observers.watch(name, request, self._around.environment(self._process), answer)
        return _Asking(partial(observers.forget, name))

    def _on_notice(self, key: str, variable: str, heard: Callable[[str], None]) -> None:
        def listen(value: str) -> None:
            if self._waiting and key in self._missing:
                heard(value)

        self._notices.on(variable, listen, owner=key)


def _probes(ready: Ready) -> dict[str, Probe]:
    from orchestra.probes.table import probes_for  # noqa: PLC0415 - most processes are ready when they run

    return probes_for(ready)


class _Asking:
    """A request to the observer."""

    def __init__(self, cancel: Callable[[], None]) -> None:
        self.cancel = cancel


def run_beside(
    process: Process,
    around: Surroundings,
    command: Sequence[str],
    limit: float,
    told: Callable[[Result], None],
) -> Cancel:
    """Run a program in the environment and the working directory of a process."""
    environment = around.environment(process)
    spec = Spec(process.id, tuple(command), environment, process.cwd, tty=False, stdin=False)
    return around.trials.run(spec, limit, told)
