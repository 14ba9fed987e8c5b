"""How a run comes to its end: level by level, faster for who is impatient, and with one deadline for everything."""

from __future__ import annotations

import signal
from functools import partial
from typing import TYPE_CHECKING

from orchestra.supervise.keeping import proc
from orchestra.supervise.process import life, order
from orchestra.supervise.process.ending import signal_name
from orchestra.supervise.process.life import LIVE, Phase
from orchestra.supervise.process.rules import stop_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.supervise.process.unit import Unit
    from orchestra.supervise.surroundings import Surroundings

# What the kernel has not ended this long after SIGKILL, in seconds, it will not end soon (an uninterruptible wait).
_GIVE_UP_AFTER = 0.7

# What has been killed and waits for a processor to end on, it will have ended at some time; in seconds.
_MOST_FOR_A_PROCESSOR = 10.0

# How often Ctrl-C was pressed.
_ONCE, _TWICE = 1, 2


class Stopping:
    """Ends processes in the reverse order of their dependencies."""

    def __init__(self, units: Mapping[str, Unit], surroundings: Surroundings) -> None:
        self._units = units
        self._around = surroundings
        self._levels: dict[str, int] = {}
        self._live: list[dict[str, Unit]] = []  # by level
        self._first = 0  # no lower level has any
        self._asked = -1
        self._deadline_after = order.DEADLINE
        self._interrupts = 0
        self.begun_at: float | None = None
        self.given_up = False

    @property
    def begun(self) -> bool:
        """Whether the run is coming to its end."""
        return self.begun_at is not None

    @property
    def too_late(self) -> bool:
        """Whether the deadline has passed: only what has been killed is waited for."""
        return self.remaining is not None and self.remaining <= 0.0

    @property
    def remaining(self) -> float | None:
        """The time until the deadline in seconds, None where nothing is being stopped."""
        if self.begun_at is None:
            return None
        return self.begun_at + self._deadline_after - self._around.loop.clock()

    @property
    def stuck(self) -> dict[int, str]:
        """What is left although it was killed, by pid, named for people."""
        units = [unit for unit in self._units.values() if unit.state.phase in LIVE]
        return {unit.pid: f"{unit.name} (pid {unit.pid})" for unit in units if unit.pid}

    def begin(self, cause: str) -> None:
        """Begin to stop: each level is asked at the latest when its time has come."""
        loop = self._around.loop
        self.begun_at = loop.clock()
        self._levels = order.stop_levels(unit.process for unit in self._units.values())
        self._around.recorder.record("run_stopping", cause=cause)
        for unit in self._units.values():
            unit.handle(life.StopAhead() if unit.state.phase in LIVE else life.StopRequested())
        self._live = [{} for _ in range(1 + max(self._levels.values(), default=0))]
        for unit in self._units.values():
            self.changed(unit.id)
        schedule = self._schedule()
        self._deadline_after = schedule.deadline
        for level, delay in enumerate(schedule.asked):
            loop.call_later(delay, partial(self._stop_level, level))
        loop.call_later(schedule.deadline, self._deadline)

    def _schedule(self) -> order.Schedule:
        """Plan the end; what takes longer than usual is asked of the keeper, who would lose patience."""
        live = [unit for unit in self._units.values() if unit.state.phase in LIVE]
        stops = {unit.id: stop for unit in live if (stop := stop_of(unit.process)) is not None}
        schedule = order.schedule(self._levels, stops)
        if schedule.deadline > order.DEADLINE and not self._around.more_time(schedule.deadline):
            return order.schedule(self._levels, {})
        return schedule

    def changed(self, process: str) -> None:
        """A process is in another phase; before the end of the run that is of no concern here."""
        if not self._live:
            return
        level, unit = self._levels[process], self._units[process]
        if unit.state.phase in LIVE:
            self._live[level][process] = unit
            self._first = min(self._first, level)
        else:
            self._live[level].pop(process, None)

    def go_on(self) -> None:
        """Ask the processes on which nothing that runs depends any more."""
        while self._first < len(self._live) and not self._live[self._first]:
            self._first += 1
        if self._first < len(self._live):
            self._stop_level(self._first)

    def interrupted(self, number: int) -> None:
        """Take note of one more stop signal: Ctrl-C twice means now, three times at once."""
        if number != signal.SIGINT:
            self._cut_short()
            return
        self._interrupts += 1
        name = signal_name(number)
        if self._interrupts == _ONCE and self.begun:
            self._around.journal.say(
                f"{name}: stopping already; once more for SIGTERM, twice more for SIGKILL"
            )
        elif self._interrupts == _TWICE:
            self._escalate(life.TERMINATE, f"{name} again: SIGTERM to everything")
        elif self._interrupts > _TWICE:
            self._escalate(life.KILL, f"{name} again: SIGKILL to everything")

    def _cut_short(self) -> None:
        """Take no longer than usual from now on where the keeper, who would have waited, is dead."""
        remaining = self.remaining
        if remaining is None or remaining <= order.DEADLINE:
            return
        if not self._around.more_time(remaining):
            self._deadline_after -= remaining - order.DEADLINE
            self._around.loop.call_later(order.DEADLINE, self._deadline)

    def _stop_level(self, level: int) -> None:
        if level <= self._asked:
            return
        self._asked = level
        for unit in [unit for live in self._live[self._first : level + 1] for unit in live.values()]:
            if unit.state.phase is not Phase.STOPPING:
                unit.handle(life.StopRequested())

    def _escalate(self, rung: int, announcement: str) -> None:
        self._around.journal.say(announcement)
        for unit in self._units.values():
            if unit.state.phase is not Phase.STOPPING:
                unit.handle(life.StopRequested())
            unit.handle(life.Escalated(rung))

    def _deadline(self) -> None:
        self._escalate(life.KILL, f"{self._deadline_after:g} s are over: SIGKILL to everything that is left")
        latest = self._around.loop.clock() + _MOST_FOR_A_PROCESSOR
        self._around.loop.call_later(_GIVE_UP_AFTER, partial(self._give_up, latest))

    def _give_up(self, latest: float) -> None:
        """Wait no more, unless what is left would end if it had a processor: a quota of a container may be used up."""
        again = self._around.loop.clock() < latest and any(map(proc.is_runnable, self.stuck))
        if again and self._around.more_time(_GIVE_UP_AFTER):
            self._around.loop.call_later(_GIVE_UP_AFTER, partial(self._give_up, latest))
        else:
            self.given_up = True
