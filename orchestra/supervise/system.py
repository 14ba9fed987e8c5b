"""A running plan: what its processes, its triggers and the user do to it, and how it all ended."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.plan.reactions import LogAction, ShutdownAction, StartAction
from orchestra.supervise import life
from orchestra.supervise.beginning import Beginning
from orchestra.supervise.ending import Ending, signal_name
from orchestra.supervise.life import FINAL, LIVE, Phase
from orchestra.supervise.outcome import Facts
from orchestra.supervise.stopping import Stopping
from orchestra.supervise.triggers import Triggers, actions_while_stopping, held
from orchestra.supervise.unit import Unit

if TYPE_CHECKING:
    from orchestra.plan.model import Plan
    from orchestra.plan.reactions import Trigger, TriggeredAction
    from orchestra.supervise.options import RunOptions
    from orchestra.supervise.surroundings import Surroundings


class System:
    """The processes of a plan and what connects them."""

    def __init__(self, plan: Plan, options: RunOptions, surroundings: Surroundings) -> None:
        self._around = surroundings
        self._options = options
        self._units = {process.id: Unit(process, surroundings, self) for process in plan.processes}
        self._beginning = Beginning(self._units, held(plan.triggers), surroundings, self)
        self._triggers = Triggers(plan.triggers, surroundings.loop, self._fire)
        self.stopping = Stopping(self._units, surroundings)
        self._dirty = False
        self._signal: int | None = None
        self._required: tuple[str, Ending] | None = None
        self._failure: str | None = None
        self._ended_by: str | None = None

    @property
    def over(self) -> bool:
        """Whether nothing runs, and nothing that could still begin is left."""
        if self.stopping.given_up:
            return True
        if self._dirty or self._triggers.pending:
            return False
        lively = {*LIVE, Phase.RESTARTING}
        return not any(unit.state.phase in lively for unit in self._units.values())

    def begin(self) -> None:
        """Begin what waits for nothing."""
        self._beginning.prepare_observers()
        for unit in self._units.values():
            self._around.recorder.record("process_waiting", unit.id)
        self._triggers.run_started()
        self.changed()

    def finish(self) -> None:
        """Everything that has not begun by now never will."""
        for unit in self._units.values():
            if unit.state.phase not in FINAL and unit.state.phase not in LIVE:
                unit.handle(life.StopRequested())

    def stop_signal(self, number: int) -> None:
        """Somebody wants the run to end."""
        self._signal = number if self._signal is None else self._signal
        self.stopping.interrupted(number)
        name = signal_name(number)
        self._stop(name, f"{name}: stopping; once more for SIGTERM, twice more for SIGKILL")

    def facts(self, left: dict[int, str]) -> Facts:
        """Return what counts for the outcome; `left` names by pid what is there although nothing should be."""
        failed = tuple(
            (unit.name, unit.state.ending or Ending(code=1))
            for unit in self._units.values()
            if unit.state.phase is Phase.FAILED
        )
        return Facts(
            unstoppable=tuple({**left, **self.stopping.stuck}.values()),
            required=self._required,
            signal=self._signal,
            failure=self._failure,
            failed=failed,
            fail_on_any=self._options.fail_on_any,
            ended_by=self._ended_by,
        )

    # What the processes tell.

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
        if self.stopping.begun:
            return
        self._around.journal.say(reason)
        if about is not None:
            self._show_last_lines(self._units[about])
        self._failure = reason
        self._stop(reason)

    def look(self) -> None:
        """Find out who became our child and whose child it was, and who of them has ended."""
        new, ended = self._around.kin.refresh()
        for adopted in new:
            unit = self._units.get(adopted.owner or "")
            if unit:
                unit.adopted(adopted)
        for owner in {adopted.owner for adopted in ended}:
            unit = self._units.get(owner or "")
            if unit and not self._around.kin.of(owner):
                unit.nothing_left()

    # What follows from it.

    def _evaluate(self) -> None:
        self._dirty = False
        if not self.stopping.begun:
            self._judge_ends()
        if self.stopping.begun:
            self.stopping.go_on()
        else:
            self._beginning.begin_or_skip()
        if not any(unit.awaits_message for unit in self._units.values()):
            self._around.observers.leave()

    def _judge_ends(self) -> None:
        """A required process that is over for good takes the run with it."""
        over = [unit for unit in self._units.values() if unit.process.required and unit.over]
        if not over:
            return
        unit = next((unit for unit in over if unit.state.phase is Phase.FAILED), over[0])
        if unit.state.phase is Phase.FAILED:
            self._required = (unit.name, unit.state.ending or Ending(code=1))
            self._show_last_lines(unit)
        self._end_with(f"required process {unit.name} has ended")

    def _show_last_lines(self, unit: Unit) -> None:
        if unit.tail.lines:
            lines = "\n".join(f"    {line}" for line in unit.tail.lines)
            self._around.journal.say(f"last lines of {unit.name}:\n{lines}")

    def _fire(self, trigger: Trigger) -> None:
        actions = actions_while_stopping(trigger.do) if self.stopping.begun else trigger.do
        names = [action.action for action in actions]
        self._around.recorder.record("trigger_fired", trigger.on.target, on=trigger.on.event, do=names)
        for action in actions:
            self._carry_out(action)
        if trigger.deferred:
            self.failed(
                f"{trigger.location}: what a Python function decides at run time cannot be carried out"
            )
        self.changed()

    def _carry_out(self, action: TriggeredAction) -> None:
        match action:
            case LogAction(message):
                self._around.journal.say(message)
            case StartAction(process):
                self._beginning.release(self._units[process])
            case ShutdownAction(reason):
                self._end_with(f"shut down: {reason}")

    def _end_with(self, reason: str) -> None:
        self._ended_by = reason
        self._stop(reason, f"{reason}: stopping")

    def _stop(self, cause: str, announcement: str | None = None) -> None:
        if self.stopping.begun:
            return
        if announcement:
            self._around.journal.say(announcement)
        self._triggers.stop()
        self._beginning.stop()
        self._around.observers.leave()
        self.stopping.begin(cause)
        self.changed()
