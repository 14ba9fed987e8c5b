"""A running plan: what its processes, its triggers and the user do to it, and how it all ended."""

from __future__ import annotations

import signal
from typing import TYPE_CHECKING

from orchestra.plan import codec
from orchestra.supervise.graph.nodes import Nodes
from orchestra.supervise.operation import Operation
from orchestra.supervise.process import life
from orchestra.supervise.process.beginning import Beginning
from orchestra.supervise.process.ending import signal_name
from orchestra.supervise.process.life import FINAL, LIVE
from orchestra.supervise.process.roll import Roll
from orchestra.supervise.process.stopping import Stopping
from orchestra.supervise.process.unit import Unit
from orchestra.supervise.reactions import happening as happenings
from orchestra.supervise.reactions.actions import Actions
from orchestra.supervise.reactions.performance import Performance
from orchestra.supervise.reactions.triggers import LONGEST_AT_THE_END, Triggers, held
from orchestra.supervise.runs.furnishing import furnish
from orchestra.supervise.verdict import Verdict

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from orchestra.plan.model import Plan, Process
    from orchestra.plan.reactions import Trigger, TriggeredAction
    from orchestra.supervise.outcome import Facts
    from orchestra.supervise.process.ending import Ending
    from orchestra.supervise.reactions.fragment import Fragment
    from orchestra.supervise.surroundings import Surroundings

# As many of a process are shown where it ends the run.
_LAST_LINES = 10


class System:
    """The processes of a plan and what connects them."""

    def __init__(self, plan: Plan, surroundings: Surroundings) -> None:
        self._around = surroundings
        self._plan = plan
        self._revision = 0
        self._units: dict[str, Unit] = {}
        self._beginning = Beginning(self._units, surroundings, self)
        self._performance = Performance(self, surroundings.questions, surroundings)
        self._triggers = Triggers(surroundings.loop, self._performance.begin)
        self._nodes = Nodes(surroundings, self._triggers.happened, self.went_wrong, self.changed)
        self._roll = Roll(self._units, self._beginning.holds, self._nodes.concerns)
        self.stopping = Stopping(self._units, surroundings)
        self._actions = Actions(self._units, self._beginning, self._triggers, self._nodes, self.end_with)
        self.operation = Operation(self._units, self._beginning, self.stopping, surroundings, self.end_with)
        self._verdict = Verdict(self._units, fail_on_any=surroundings.options.fail_on_any)
        self._pids: dict[str, int] = {}
        self._dirty = False
        self._looked_in = -1

    @property
    def over(self) -> bool:
        """Whether nothing runs, and nothing that could still begin is left."""
        if self.stopping.given_up:
            return True
        if self._dirty or self._triggers.pending or self._nodes.pending:
            return False
        if self._around.questions.pending and not self.stopping.too_late:
            return False
        return not self._roll.keeps_on(ending=self.ending)

    @property
    def ending(self) -> bool:
        """Whether the run is coming to its end."""
        return self.stopping.begun

    def begin(self) -> None:
        """Begin what waits for nothing."""
        self._add(self._plan.processes)
        self._beginning.hold(held(self._plan.triggers))
        self._nodes.add(self._plan.processes, self._plan.components, self._plan.triggers)
        self._triggers.add(self._plan.triggers)
        self._beginning.prepare_tools(self._roll.observed)
        self._triggers.happened(happenings.run_started())
        self.changed()

    def finish(self) -> None:
        """Everything that has not begun by now never will."""
        self._nodes.stop()
        for unit in self._units.values():
            if unit.state.phase not in FINAL and unit.state.phase not in LIVE:
                unit.handle(life.StopRequested())

    def stop_signal(self, number: int) -> None:
        """Somebody wants the run to end."""
        self._verdict.signalled(number)
        self.stopping.interrupted(number)
        name = signal_name(number)
        self._stop(
            name,
            f"{name}: stopping; once more for SIGTERM, twice more for SIGKILL",
            due_to_sigint=number == signal.SIGINT,
        )

    def facts(self, left: dict[int, str]) -> Facts:
        """Return what counts for the outcome; `left` names by pid what is there although nothing should be."""
        return self._verdict.facts({**left, **self.stopping.stuck})

    def state_report(self) -> str:
        """Return what runs and what is waited for, in lines for people."""
        from orchestra.supervise.state_report import state_report  # noqa: PLC0415 - few ask for it

        return state_report(self.operation.processes(), self.stopping)

    # What the processes tell.

    def changed(self, process: str | None = None) -> None:
        """A process is in another phase, or something else has changed: see, after what is going on, who may begin."""
        self._roll.changed(process)
        if process is not None:
            self._beginning.changed(process)
            self.stopping.changed(process)
        self.again()

    def again(self) -> None:
        """Something is left for the next round."""
        if not self._dirty:
            self._dirty = True
            self._around.loop.call_later(0.0, self._evaluate)

    def started(self, process: str, pid: int) -> None:
        """The program of a process runs."""
        self._pids[process] = pid
        if not self.ending:
            self._nodes.started(process, pid)
        self._triggers.happened(happenings.started(process, pid))

    def ended(self, process: str, pid: int | None, ending: Ending, *, intended: bool) -> None:
        """One run of a process is over, or has not come about; what an operator ends sets off no trigger."""
        self._nodes.ended(process, str(ending))
        if not intended:
            self._triggers.happened(happenings.ended(process, pid, ending, last=False))

    def completed(self, process: str, ending: Ending, *, intended: bool) -> None:
        """A process will not start again by itself."""
        self._nodes.never(process, f"has ended ({ending})")
        if not intended:
            self._triggers.happened(happenings.ended(process, self._pids.get(process), ending, last=True))

    def skipped(self, process: str) -> None:
        """A process will never begin."""
        self._nodes.never(process, "was skipped")

    def wrote(self, process: str, pid: int, stream: str, data: bytes) -> None:
        """A program has written something."""
        if self._triggers.awaits("process_output"):
            self._triggers.happened(happenings.wrote(process, pid, stream, data))

    def failed(self, reason: str, about: str | None = None) -> None:
        """End the run because of something that is nobody's exit code."""
        if self.stopping.begun:
            return
        self._around.journal.say(reason)
        if about is not None:
            self._show_last_lines(self._units[about])
        self._verdict.failed(reason)
        self._stop(reason)

    def went_wrong(self, what: str) -> None:
        """Take note of something that the plan says and that was not done; the run goes on."""
        self._around.journal.say(f"error: {what}")
        self._verdict.went_wrong(what)

    def look(self) -> None:
        """Find out who became our child and who has ended: once a round, for what had happened by its begin."""
        if self._looked_in != self._around.loop.round:
            self.child_ended()

    def child_ended(self) -> None:
        """Look in any case: it may have ended after this round's look, and nobody will tell us again."""
        self._looked_in = self._around.loop.round
        new, ended = self._around.kin.refresh()
        for adopted in new:
            unit = self._units.get(adopted.owner or "")
            if unit:
                unit.adopted(adopted)
        for owner in {adopted.owner for adopted in ended}:
            unit = self._units.get(owner or "")
            if unit and not self._around.kin.of(owner):
                unit.nothing_left()

    def quiesce(self, process: str, done: Callable[[], None]) -> None:
        """Deactivate the lifecycle nodes in a process before it is ended."""
        self._nodes.quiesce(process, done)

    def carry_out(self, action: TriggeredAction) -> None:
        """Do what a trigger says."""
        self._actions.carry_out(action)
        self._roll.carried_out(action)
        self.again()

    def trigger_failed(self, reason: str) -> None:
        """A trigger could not do what it should: the run is not what was described."""
        if self.ending:
            self.went_wrong(reason)
        else:
            self.failed(reason)

    def revise(self, fragment: Fragment, trigger: Trigger) -> str | None:
        """Take up what a trigger adds to the plan; return why that is impossible, if it is."""
        from orchestra.supervise.reactions.fragment import merged  # noqa: PLC0415 - few plans are revised

        plan, fault = merged(self._plan, fragment)
        if fault:
            return f"what it adds does not fit into the plan: {fault}"
        unfit = self._around.confines.take_up(plan)
        if unfit:
            return unfit
        self._revision += 1
        self._around.recorder.record(
            "plan_revised", trigger=trigger.id, revision=self._revision, **codec.encode(fragment)
        )
        if self.ending:
            return None
        try:
            fragment = furnish(fragment, str(self._around.folder))
        except OSError as error:
            return f"its parameter files cannot be written: {error}"
        self._plan = plan
        self._take_up(fragment)
        return None

    def end_with(self, reason: str, told: str | None = None) -> None:
        """End the run because the plan says so.

        Triggers on the end hear the reason; `told` is what the terminal shows instead of it.
        """
        told = reason if told is None else told
        self._verdict.ended_by(told)
        self._stop(reason, f"{told}: stopping")

    # What follows from it.

    def _take_up(self, fragment: Fragment) -> None:
        self._around.journal.add({process.id: process.output for process in fragment.processes})
        self._add(fragment.processes)
        self._beginning.hold(held(fragment.triggers, fragment.do))
        self._nodes.add(fragment.processes, fragment.components, fragment.triggers)
        self._triggers.add(fragment.triggers)
        self._nodes.watch()
        self.changed()

    def _add(self, processes: Iterable[Process]) -> None:
        self._beginning.add(processes)
        for process in processes:
            self._units[process.id] = Unit(process, self._around, self)
            self._around.recorder.record("process_waiting", process.id)

    def _evaluate(self) -> None:
        self._dirty = False
        if not self.stopping.begun:
            self._judge_ends()
        if self.stopping.begun:
            self.stopping.go_on()
        else:
            self._beginning.begin_or_skip()
        self._around.service.changed(self._units.values(), self._beginning.holds, self.stopping.remaining)
        if self.stopping.begun or not self._roll.needs_observer:
            self._around.observers.relieve()

    def _judge_ends(self) -> None:
        """A required process that is over for good takes the run with it."""
        unit = self._verdict.required_end() if self._roll.required_over else None
        if unit:
            self.end_with(f"required process {unit.name} has ended")

    def _show_last_lines(self, unit: Unit) -> None:
        if last := unit.tail.lines[-_LAST_LINES:]:
            lines = "\n".join(f"    {line}" for line in last)
            self._around.journal.say(f"last lines of {unit.name}:\n{lines}")

    def _stop(self, cause: str, announcement: str | None = None, *, due_to_sigint: bool = False) -> None:
        """End the run; a required process that failed just before gives it its status, whatever the cause."""
        if self.stopping.begun:
            return
        if blamed := self._verdict.blame():
            self._show_last_lines(blamed)
        if announcement:
            self._around.journal.say(announcement)
        self._around.questions.hurry()
        for trigger in self._triggers.stop():
            self._around.journal.say(
                f"{trigger.location}: dropped: it would come later than {LONGEST_AT_THE_END:g} s after the end"
            )
        self._beginning.stop()
        self._nodes.stop()
        self._around.observers.drop()
        self.stopping.begin(cause)
        self._triggers.happened(happenings.shutdown(cause, due_to_sigint=due_to_sigint))
        self.changed()
