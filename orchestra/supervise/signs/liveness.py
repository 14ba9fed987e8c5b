"""Expects the signs of life of one process, run by run, once it is ready.

Where nothing says when it is ready, each sign is expected from its first time on. A process that is stopped (SIGSTOP,
Ctrl-Z, a debugger) does not hang: somebody wants it so, and its time begins anew when that is found. Nor does it hang
while we ourselves were stopped, or when the observer dies: then nobody has looked.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Protocol

from orchestra.logs.names import shown
from orchestra.supervise.keeping import proc
from orchestra.supervise.process import life
from orchestra.supervise.signs.readiness import run_beside
from orchestra.values import Stop

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.plan.model import Process
    from orchestra.supervise.signs.notification import Notices
    from orchestra.supervise.surroundings import Surroundings

# What a user is shown of the threads; the event has all.
_SHOWN = 8
_STOPPED = frozenset("Tt")


class _Watch(Protocol):
    """A kind of sign."""

    def begin(self, *, armed: bool) -> None:
        """Expect it; not armed, from the first one on."""

    def end(self) -> None:
        """Expect it no longer."""


class Liveness:
    """Tells `handle` that the process hangs, after where its threads are; `blind` why nobody can tell."""

    def __init__(
        self,
        process: Process,
        surroundings: Surroundings,
        notices: Notices,
        handle: Callable[[life.Event], None],
        blind: Callable[[str], None],
    ) -> None:
        self._process = process
        self._around = surroundings
        self._handle = handle
        self._active = False
        self._told_of_stop = False
        self._watches = self._make(notices, blind)

    @property
    def looks_into_graph(self) -> bool:
        """Whether it needs the observer."""
        return self._process.alive is not None and self._process.alive.message is not None

    def begin(self) -> None:
        """Expect the signs from now on."""
        self._active = True
        self._told_of_stop = False
        for watch in self._watches:
            watch.begin(armed=self._process.ready is not None)

    def end(self) -> None:
        """Expect nothing any more."""
        self._active = False
        for watch in self._watches:
            watch.end()

    def _make(self, notices: Notices, blind: Callable[[str], None]) -> list[_Watch]:
        alive, process, around = self._process.alive, self._process, self._around
        made: list[_Watch] = []
        if alive is None:
            return made
        # Here, because few processes are to give signs of life.
        from orchestra.supervise.signs.health import Health  # noqa: PLC0415
        from orchestra.supervise.signs.message_rate import MessageRate  # noqa: PLC0415
        from orchestra.supervise.signs.watchdog import Watchdog  # noqa: PLC0415

        if alive.notify is not None:
            stop = process.stop or Stop()
            farewell = stop.timeout + stop.kill_timeout
            made.append(Watchdog(around.loop, notices, alive.notify, farewell, self._silent))
        if alive.message is not None:
            made.append(
                MessageRate(
                    around.loop,
                    around.observers,
                    lambda: around.environment(process),
                    f"rate {process.id}",
                    (alive.message, alive.min_rate, alive.window),
                    self._silent,
                    blind,
                )
            )
        if alive.command is not None:
            made.append(Health(around.loop, alive, partial(run_beside, process, around), self._silent))
        return made

    def _silent(self, reason: str) -> bool:
        """There was no sign: tell whether the process hangs."""
        if not self._active:
            return False
        from orchestra.supervise.signs.threads import trees  # noqa: PLC0415 - as above

        pids = self._around.kin.members(self._process.id)
        if any((facts := proc.stat(pid)) and facts.state in _STOPPED for pid in trees(pids)):
            if not self._told_of_stop:
                self._told_of_stop = True
                name = shown(self._process.id)
                self._around.journal.say(
                    f"{name} gives no sign of life, but is stopped: it does not count as hung"
                )
            return False
        self._dump(reason, pids)
        self._handle(life.Hung(reason))
        return True

    def _dump(self, reason: str, pids: list[int]) -> None:
        """Keep where the threads are, and show it: once it is ended nobody can tell any more."""
        # As above.
        from dataclasses import asdict  # noqa: PLC0415

        from orchestra.supervise.signs.threads import threads  # noqa: PLC0415

        found = threads(pids)
        lines = [f"    {thread}" for thread in found[:_SHOWN]]
        if len(found) > _SHOWN:
            lines.append(f"    and {len(found) - _SHOWN} more threads, in the event")
        self._around.journal.say("\n".join((f"where {shown(self._process.id)} is:", *lines)))
        self._around.recorder.record(
            "process_hung", self._process.id, reason=reason, threads=[asdict(thread) for thread in found]
        )
