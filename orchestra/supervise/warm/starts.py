"""Starts the processes of the plan: warm, by the fork server, where the plan says so, and cold else.

A server that is lost is replaced at the next start; a second loss within a minute, and one that says that it is of no
use, leaves everything cold. Whatever goes wrong with a warm start, the process is started cold.
"""

from __future__ import annotations

import errno
import itertools
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol

from orchestra.supervise.keeping import proc
from orchestra.supervise.process.life import FINAL
from orchestra.supervise.process.spawn import spawn

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from orchestra.plan.model import Process, Warm
    from orchestra.supervise.keeping.kin import Kin
    from orchestra.supervise.loop import Loop, Timer
    from orchestra.supervise.process.life import State
    from orchestra.supervise.process.spec import Spec
    from orchestra.supervise.warm.launching import Launched
    from orchestra.supervise.warm.server import Server
    from orchestra.supervise.warm.start import Start, Told

# How long the server may take for one start, its own imports included, and a node that is there until it begins, on a
# machine that is busy; in seconds.
_PATIENCE = 15.0
_TWICE_WITHIN = 60.0
# It ends when nobody can ask any more, but not before its imports are over; in seconds.
_LEAVE_WITHIN = 0.3
# What it calls itself (ros/warm/serving.py), and its copies as long as they are not nodes yet.
_NAME = "orc-warm"


class Startable(Protocol):
    """A process of the plan, and where it is in its life."""

    @property
    def process(self) -> Process:
        """What the plan says of it."""

    @property
    def state(self) -> State:
        """Where it is."""


class Starts:
    """Starts processes. `said` gets what users should know of the server; without `wanted` there is none.

    `ahead` is a server that has been started already.
    """

    def __init__(
        self, loop: Loop, kin: Kin, run_id: str, said: Callable[[str], None], ahead: Launched | None = None
    ) -> None:
        self.said = said
        self.wanted = True
        self._loop = loop
        self._kin = kin
        self._run_id = run_id
        self._prepared: set[tuple[str, str]] = set()
        self._server: Server | None = None
        self._former: list[Server] = []
        self._numbers = itertools.count(1)
        self._open: dict[int, Start] = {}
        self._lost_at: float | None = None
        self._hopeless: str | None = None
        self._timer: Timer | None = None
        self._heard_at = 0.0  # when the server has last told of a node
        self._reasons: set[str] = set()
        kin.unborn = self._is_unborn
        if ahead is not None:
            self._server = self._attended(ahead)

    @cached_property
    def _environment(self) -> dict[str, str]:
        """What a server has, and all that it starts."""
        # Here and below: what has to do with a server is imported where there is one.
        from orchestra.supervise.libraries import host_of_run  # noqa: PLC0415
        from orchestra.supervise.warm.launching import environment_of  # noqa: PLC0415

        return environment_of(self._run_id, host_of_run())

    @property
    def pid(self) -> int | None:
        """The pid of the server that is at work."""
        return self._server.pid if self._server is not None else None

    @property
    def alive(self) -> bool:
        """Whether a server's process has not been reaped."""
        self._former = [one for one in self._former if one.alive]
        return bool(self._former) or (self._server is not None and self._server.alive)

    def prepare(self, processes: Iterable[Process]) -> None:
        """Let the server, which takes some time for it, import what those of the processes need that it will start."""
        targets = {(warm.kind or "", warm.target or "") for warm in map(_warm, processes) if warm is not None}
        server = self._ready() if targets - self._prepared else None
        if server:
            fresh = sorted(targets - self._prepared)
            self._prepared |= targets  # first, because a server that is lost is told of them again
            server.tell({"prepare": fresh})

    def start(self, process: Process, spec: Spec, told: Told) -> None:
        """Start a process; `told` hears what comes of it, at once where it is started cold."""
        if _warm(process) is None or spec.foremost or not self.wanted:
            _start_cold(spec, told)
            return
        from orchestra.supervise.warm import dialogue  # noqa: PLC0415
        from orchestra.supervise.warm.start import Start  # noqa: PLC0415

        differs = dialogue.obstacle(spec.environment, self._environment)
        server = None if differs else self._ready()
        if server is None:
            self._start_cold(
                spec,
                told,
                f"its {differs} is another one" if differs else f"the fork server {self._hopeless}",
            )
            return
        number = next(self._numbers)
        try:
            start = Start(
                *(self._loop, process, spec, told),
                over=lambda: self._close(number),
                cold=lambda reason: self._start_cold(spec, told, reason),
            )
        except OSError as error:
            told.failed(error)
            return
        self._open[number] = start
        self._be_patient()
        request = dialogue.request(number, process, spec, server.environment)
        server.tell(request, start.descriptors, start.sent)

    def withdraw(self, process: str) -> None:
        """Do not start a process that is not there yet: somebody wants its end already."""
        for start in [one for one in self._open.values() if one.process.id == process and one.pid is None]:
            start.cancel(OSError(errno.ECANCELED, "it was to end before it had begun"))

    def relieve(self, units: Iterable[Startable]) -> None:
        """Let the server end where none of these runs or will that it starts."""
        if self._server is None or self._open:
            return
        if not any(_warm(unit.process) and unit.state.phase not in FINAL for unit in units):
            self._dismiss()

    def leave(self) -> None:
        """Let the server end, whatever is to be started."""
        for start in [*self._open.values()]:
            start.cancel(OSError(errno.ECANCELED, "the run has ended"))
        self._dismiss()

    def _dismiss(self) -> None:
        if self._server is not None:
            self._loop.call_later(_LEAVE_WITHIN, self._server.kill)
            self._retire()

    def _ready(self) -> Server | None:
        """Return the server, started where there is none; None where there will not be one."""
        if self._server is None and self._hopeless is None and self.wanted:
            from orchestra.supervise.warm.launching import launch  # noqa: PLC0415

            try:
                self._server = self._attended(launch(self._environment))
            except OSError as error:
                self._hopeless = f"could not be started: {error}"
        return self._server

    def _attended(self, launched: Launched) -> Server:
        from orchestra.supervise.warm.server import Server  # noqa: PLC0415

        return Server(self._loop, self._kin, launched, self._say, (self._heard, self._lost))

    def _start_cold(self, spec: Spec, told: Told, reason: str) -> None:
        """Start cold what the plan starts warm; users are told each reason once."""
        told.cold(reason)
        if reason not in self._reasons:
            self._reasons.add(reason)
            self.said(f"{spec.id} is started without the fork server: {reason}")
        _start_cold(spec, told)

    def _say(self, text: str) -> None:
        self.said(f"fork server: {text.rstrip()}")

    def _heard(self, message: dict[str, Any]) -> None:
        if "unusable" in message:
            self._hopeless = f"is of no use: {message['unusable']}"
            self._lost("")
            return
        start = self._open.get(message["id"])
        self._heard_at = self._loop.clock()
        if "pid" in message and start is not None:
            self._kin.add(message["pid"], start.process.id)
            start.there(message["pid"])
        elif "cold" in message and start is not None:
            start.give_up(message["cold"])

    def _lost(self, reason: str) -> None:
        now, before = self._loop.clock(), self._lost_at
        self._lost_at = now
        if self._hopeless is None and before is not None and now < before + _TWICE_WITHIN:
            self._hopeless = f"{reason}, and so did the one before"
        self._retire()
        why = self._hopeless or reason
        for start in [one for one in self._open.values() if one.pid is None]:
            start.give_up(f"the fork server {why}")

    def _retire(self) -> None:
        if self._server is not None:
            self._server.leave()
            self._former.append(self._server)
            self._server = None
            self._prepared.clear()

    def _close(self, number: int) -> None:
        start = self._open.pop(number)
        if start.pid is not None and start.withdrawn:
            self._kin.remove(start.pid)
        if not self._open and self._timer:
            self._timer.cancel()
            self._timer = None

    def _be_patient(self) -> None:
        if self._timer is None and self._open:
            seconds = min(map(self._due, self._open.values())) - self._loop.clock()
            self._timer = self._loop.call_later(max(0.0, seconds), self._lose_patience)

    def _due(self, start: Start) -> float:
        """Return how long there is patience with a start: the server makes one after the other."""
        since = start.since if start.pid is not None else max(start.since, self._heard_at)
        return since + _PATIENCE

    def _lose_patience(self) -> None:
        """What should have begun by now is started cold, with all that the server owes if that is silent."""
        self._timer = None
        now = self._loop.clock()
        late = [start for start in self._open.values() if self._due(start) <= now]
        if any(start.pid is None for start in late):
            if self._server is not None:
                self._server.kill()
            self._lost(f"has not answered for {_PATIENCE:g} s")
        for start in [start for start in late if start.pid is not None]:
            start.give_up(f"it has not begun for {_PATIENCE:g} s")
        self._be_patient()

    def _is_unborn(self, pid: int) -> bool:
        """Tell whether a child of ours is a node that the server has forked and not told of yet."""
        return any(start.pid is None for start in self._open.values()) and proc.name(pid) == _NAME


def _warm(process: Process) -> Warm | None:
    """Return how the server starts a process, None where it does not."""
    return process.warm if process.warm is not None and process.warm.warm else None


def _start_cold(spec: Spec, told: Told) -> None:
    """Start a program by itself."""
    try:
        child = spawn(spec)
    except OSError as error:
        told.failed(error)
        return
    told.begun(child, spec)
