"""A running plan: begins processes when they may, fires triggers, stops everything, and knows how it all ended."""

from __future__ import annotations

import signal
from functools import partial
from typing import TYPE_CHECKING

from orchestra.logs.names import shown
from orchestra.plan.model import LogAction, ShutdownAction, StartAction
from orchestra.supervise import life, order
from orchestra.supervise.ending import Ending, signal_name
from orchestra.supervise.life import FINAL, LIVE, Phase
from orchestra.supervise.outcome import Facts
from orchestra.supervise.triggers import Triggers, actions_while_stopping, held
from orchestra.supervise.unit import Unit

if TYPE_CHECKING:
    from orchestra.plan.model import Dependency, Plan, Trigger
    from orchestra.supervise.loop import Timer
    from orchestra.supervise.options import RunOptions
    from orchestra.supervise.surroundings import Surroundings

# However long the steps of single processes are: after this time, in seconds, everything that is left is killed.
DEADLINE = 5.0
# What the kernel has not ended this long after SIGKILL, in seconds, it will not end soon (an uninterruptible wait).
_GIVE_UP_AFTER = 0.7


class System:
    """The processes of a plan and what connects them."""

    def __init__(self, plan: Plan, options: RunOptions, surroundings: Surroundings) -> None:
        self._around = surroundings
        self._options = options
        self.units = {process.id: Unit(process, surroundings, self) for process in plan.processes}
        self._held = set(held(plan.triggers))
        self._triggers = Triggers(plan.triggers, surroundings.loop, self._fire)
        self._levels = order.stop_levels(plan.processes)
        self._edge_timers: dict[tuple[str, Dependency], Timer] = {}
        self._stopping = False
        self._interrupts = 0
        self._dirty = False
        self._signal: int | None = None
        self._required: tuple[str, Ending] | None = None
        self._failure: str | None = None
        self._ended_by: str | None = None
        self._given_up = False
        self.stopped_at: float | None = None

    @property
    def stopping(self) -> bool:
        """Whether the run is coming to its end."""
        return self._stopping

    @property
    def over(self) -> bool:
        """Whether nothing runs, and nothing that could still begin is left."""
        if self._given_up:
            return True
        if self._dirty or self._triggers.pending:
            return False
        lively = any(
            unit.state.phase in LIVE or unit.state.phase is Phase.RESTARTING for unit in self.units.values()
        )
        return not lively

    def begin(self) -> None:
        """Begin what waits for nothing."""
        if any(unit.awaits_message for unit in self.units.values()):
            self._prepare_observers()
        for unit in self.units.values():
            self._around.recorder.record("process_waiting", unit.id)
        self._triggers.run_started()
        self.changed()

    def finish(self) -> None:
        """Everything that has not begun by now never will."""
        for unit in self.units.values():
            if unit.state.phase not in FINAL and unit.state.phase not in LIVE:
                unit.handle(life.StopRequested())

    def facts(self, unstoppable: tuple[str, ...]) -> Facts:
        """Return what counts for the outcome."""
        failed = tuple(
            (unit.name, unit.state.ending or Ending(code=1))
            for unit in self.units.values()
            if unit.state.phase is Phase.FAILED
        )
        return Facts(
            unstoppable=unstoppable,
            required=self._required,
            signal=self._signal,
            failure=self._failure,
            failed=failed,
            fail_on_any=self._options.fail_on_any,
            ended_by=self._ended_by,
        )

    # What the units tell.

    def changed(self) -> None:
        """A process is in another phase: see, after what is going on, who may begin."""
        if not self._dirty:
            self._dirty = True
            self._around.loop.call_later(0.0, self._evaluate)

    def ended(self, process: str) -> None:
        """One run of a process is over."""
        self._triggers.process_ended(process)

    def failed(self, reason: str, about: str | None = None) -> None:
        """End the run because of something that is nobody's exit code."""
        if self._stopping:
            return
        self._around.journal.say(reason)
        if about is not None:
            self._show_last_lines(self.units[about])
        self._failure = self._failure or reason
        self._stop(reason)

    def look(self) -> None:
        """Find out who became our child and whose child it was, and who of them has ended."""
        new, ended = self._around.kin.refresh()
        for adopted in new:
            unit = self.units.get(adopted.owner or "")
            if unit:
                unit.adopted(adopted)
        for owner in {adopted.owner for adopted in ended}:
            unit = self.units.get(owner or "")
            if unit and not self._around.kin.of(owner):
                unit.nothing_left()

    # What comes from outside.

    def stop_signal(self, number: int) -> None:
        """Somebody wants the run to end: SIGINT twice means now, three times at once."""
        if self._signal is None:
            self._signal = number
        if number == signal.SIGINT:
            self._interrupts += 1
        name = signal_name(number)
        if not self._stopping:
            self._stop(name, f"{name}: stopping; once more for SIGTERM, twice more for SIGKILL")
        elif self._interrupts == 1 and number == signal.SIGINT:
            self._around.journal.say(
                "SIGINT: stopping already; once more for SIGTERM, twice more for SIGKILL"
            )
        elif self._interrupts == 2:  # noqa: PLR2004 - the second Ctrl-C
            self._escalate(life.TERMINATE, f"{name} again: SIGTERM to everything")
        elif self._interrupts > 2:  # noqa: PLR2004 - the third
            self._escalate(life.KILL, f"{name} again: SIGKILL to everything")

    # Beginning.

    def _evaluate(self) -> None:
        self._dirty = False
        if not self._stopping:
            self._judge_ends()
        if self._stopping:
            self._stop_next()
        else:
            self._begin_or_skip()
        if not any(unit.awaits_message for unit in self.units.values()):
            self._around.observers.leave()

    def _begin_or_skip(self) -> None:
        lives = {name: unit.standing for name, unit in self.units.items()}
        for unit in self.units.values():
            if unit.state.phase is not Phase.WAITING:
                continue
            fate = order.fate(unit.process.depends_on, lives)
            if fate.blocker:
                self._skip(unit, fate.blocker)
            elif unit.id in self._held:
                continue
            elif fate.begin:
                unit.handle(life.Start())
            else:
                self._time_edges(unit, fate.awaited)

    def _skip(self, unit: Unit, blocker: Dependency) -> None:
        target = shown(blocker.process)
        reason = f"{unit.name} is skipped: {target} will not be {_PARTICIPLES[blocker.condition]} any more"
        self._around.journal.say(reason)
        unit.handle(life.Skip())
        if unit.process.required:
            self.failed(f"required process {unit.name} could not begin: {target} never was "
                        f"{_PARTICIPLES[blocker.condition]}")  # fmt: skip

    def _time_edges(self, unit: Unit, awaited: tuple[Dependency, ...]) -> None:
        """Start the clock of each edge: for a start with the run, for everything later with the start it follows."""
        for edge in awaited:
            target = self.units[edge.process]
            running = edge.condition == "started" or target.state.starts > 0
            if edge.timeout is None or (unit.id, edge) in self._edge_timers or not running:
                continue
            self._edge_timers[unit.id, edge] = self._around.loop.call_later(
                edge.timeout, partial(self._edge_expired, unit, edge)
            )

    def _edge_expired(self, unit: Unit, edge: Dependency) -> None:
        target = self.units[edge.process]
        if unit.state.phase is not Phase.WAITING or order.reached(edge.condition, target.standing):
            return
        what = f" ({target.awaited})" if edge.condition == "ready" else ""
        self.failed(
            f"{unit.name} waited {edge.timeout:g} s for {target.name} to be {_PARTICIPLES[edge.condition]}{what}",
            target.id,
        )

    def _prepare_observers(self) -> None:
        """Start observers early: their imports take as long as those of the nodes that are awaited."""
        for unit in self.units.values():
            if unit.awaits_message:
                try:
                    self._around.observers.prepare(self._around.environment(unit.process))
                except OSError as error:
                    self.failed(f"the observer could not be started: {error}")

    # Ends.

    def _judge_ends(self) -> None:
        """A required process that is over for good takes the run with it."""
        over = [
            unit
            for unit in self.units.values()
            if unit.process.required and unit.state.phase in (Phase.EXITED, Phase.FAILED)
        ]
        if not over:
            return
        unit = next((unit for unit in over if unit.state.phase is Phase.FAILED), over[0])
        if unit.state.phase is Phase.FAILED:
            self._required = (unit.name, unit.state.ending or Ending(code=1))
            self._show_last_lines(unit)
        self._ended_by = f"required process {unit.name} has ended"
        self._stop(self._ended_by, f"{self._ended_by}: stopping")

    def _show_last_lines(self, unit: Unit) -> None:
        if unit.tail.lines:
            lines = "\n".join(f"    {line}" for line in unit.tail.lines)
            self._around.journal.say(f"last lines of {unit.name}:\n{lines}")

    def _fire(self, trigger: Trigger) -> None:
        actions = actions_while_stopping(trigger.do) if self._stopping else trigger.do
        self._around.recorder.record(
            "trigger_fired",
            trigger.on.target,
            on=trigger.on.event,
            do=[action.action for action in actions],
        )
        for action in actions:
            match action:
                case LogAction(message):
                    self._around.journal.say(message)
                case StartAction(process):
                    self._release(self.units[process])
                case ShutdownAction(reason):
                    self._ended_by = f"shut down: {reason}"
                    self._stop(self._ended_by, f"{self._ended_by}: stopping")
        self.changed()

    def _release(self, unit: Unit) -> None:
        """Let a process begin that only a trigger starts; one that has ended begins again."""
        self._held.discard(unit.id)
        if unit.state.phase is not Phase.WAITING:
            unit.handle(life.Start())

    # Stopping.

    def _stop(self, cause: str, announcement: str | None = None) -> None:
        if self._stopping:
            return
        self._stopping = True
        self.stopped_at = self._around.loop.clock()
        if announcement:
            self._around.journal.say(announcement)
        self._around.recorder.record("run_stopping", cause=cause)
        self._triggers.stop()
        for timer in self._edge_timers.values():
            timer.cancel()
        for unit in self.units.values():
            unit.handle(life.StopAhead() if unit.state.phase in LIVE else life.StopRequested())
        self._schedule_stop()
        self.changed()

    def _schedule_stop(self) -> None:
        """Ask one level after the other, each at the latest when its time has come, and kill what outlives them all."""
        loop = self._around.loop
        wait = order.patience(self._levels.values())
        for level in sorted(set(self._levels.values())):
            loop.call_later(wait * level, partial(self._stop_level, level))
        loop.call_later(DEADLINE, self._deadline)

    def _stop_next(self) -> None:
        """Ask the processes on which nothing that runs depends any more."""
        running = [unit for unit in self.units.values() if unit.state.phase in LIVE]
        if running:
            self._stop_level(min(self._levels[unit.id] for unit in running))

    def _stop_level(self, level: int) -> None:
        for unit in self.units.values():
            if self._levels[unit.id] <= level and unit.state.phase is not Phase.STOPPING:
                unit.handle(life.StopRequested())

    def _escalate(self, rung: int, announcement: str) -> None:
        self._around.journal.say(announcement)
        for unit in self.units.values():
            if unit.state.phase is not Phase.STOPPING:
                unit.handle(life.StopRequested())
            unit.handle(life.Escalated(rung))

    def _deadline(self) -> None:
        self._escalate(life.KILL, f"{DEADLINE:g} s are over: SIGKILL to everything that is left")
        self._around.loop.call_later(_GIVE_UP_AFTER, self._give_up)

    def _give_up(self) -> None:
        self._given_up = True

    @property
    def stuck(self) -> list[str]:
        """What is left although it was killed, named for people."""
        return [f"{unit.name} (pid {unit.pid})" for unit in self.units.values() if unit.state.phase in LIVE]


_PARTICIPLES = {"started": "started", "ready": "ready", "completed": "completed", "exited": "over"}
