"""What is recorded and told of one process: its phases, its ends, what it left behind."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.logs.names import shown
from orchestra.supervise.process.ending import signal_name
from orchestra.supervise.process.life import FINAL, Hung, Phase
from orchestra.supervise.process.machine import succeeded

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.supervise.keeping.kin import Adopted
    from orchestra.supervise.process.ending import Ending
    from orchestra.supervise.process.life import Event, Rules, State
    from orchestra.supervise.surroundings import Surroundings

# The policies under which a process starts again after a run that succeeded, and after one that did not.
_AGAIN_AFTER = {True: ("always",), False: ("always", "on-failure")}


class Account:
    """Keeps the account of a process, by its id in the plan."""

    def __init__(self, process: str, rules: Rules, surroundings: Surroundings) -> None:
        self._process = process
        self._name = shown(process)
        self._rules = rules
        self._around = surroundings

    def say(self, text: str) -> None:
        """Tell the user something of it; the text follows its name."""
        self._around.journal.say(f"{self._name} {text}")

    def entered(self, state: State, event: Event, pid: int | None) -> None:
        """Record the new phase, and tell the user what he should know."""
        phase, ending = state.phase, state.ending
        data = facts(ending) if ending and phase in FINAL else {}
        if phase is Phase.RUNNING:
            data = {"start": state.starts}
        self._around.recorder.record(
            f"process_{phase}",  # type: ignore[arg-type] # there is a kind for every phase
            self._process,
            pid=pid,
            cause=type(event).__name__,
            **data,
        )
        if phase in (Phase.EXITED, Phase.FAILED) and not state.asked:
            self._over(success=phase is Phase.EXITED)
        if isinstance(event, Hung):
            self.say(f"hangs ({event.reason}) and is ended")
        if phase is Phase.READY:
            self.say(f"is ready after {self._around.loop.clock() - state.started_at:.1f} s")

    def _over(self, *, success: bool) -> None:
        """Tell why it is not started again where that is for its budget alone."""
        restart = self._rules.restart
        if restart is None or restart.budget is None or restart.policy not in _AGAIN_AFTER[success]:
            return
        runs = "last run was" if restart.budget == 0 else f"last {restart.budget + 1} runs were each"
        self.say(f"is not started again: its {runs} shorter than {restart.min_uptime:g} s")

    def cold(self, reason: str) -> None:
        """Record that it is started by itself although the fork server was to start it."""
        self._around.recorder.record("started_cold", self._process, reason=reason)

    def ended(self, state: State, ending: Ending, pid: int, left: Iterable[Adopted]) -> None:
        """Record the end of a program, and what it leaves behind; tell it where nobody asked for it."""
        uptime = self._around.loop.clock() - state.started_at
        record = self._around.recorder.record
        record("process_ended", self._process, pid=pid, **facts(ending), uptime=round(uptime, 6))
        if state.phase is Phase.STOPPING:
            return
        verb = "ended" if succeeded(self._rules, ending) else "failed"
        self.say(f"{verb} ({ending}) after {uptime:.1f} s")
        for adopted in left:
            self.left_behind(adopted)
            self.say(f"left a process behind: {adopted.command} (pid {adopted.pid})")

    def not_started(self, ending: Ending) -> None:
        """Record and tell that the program could not be started."""
        self.say(str(ending))
        self._around.recorder.record("process_ended", self._process, **facts(ending), uptime=0.0)

    def signalled(self, pid: int | None, number: str | int) -> None:
        """Record a signal to it."""
        name = number if isinstance(number, str) else signal_name(number)
        self._around.recorder.record("signal_sent", self._process, pid=pid, signal=name)

    def adopted(self, adopted: Adopted) -> None:
        """Record that a descendant has detached itself."""
        self._around.recorder.record(
            "descendant_adopted", self._process, pid=adopted.pid, command=adopted.command
        )

    def left_behind(self, adopted: Adopted) -> None:
        """Record that something has outlived the program."""
        self._around.recorder.record("left_behind", self._process, pid=adopted.pid, command=adopted.command)


def facts(ending: Ending) -> dict[str, Any]:
    """Return what the event of an end says of it."""
    return {"code": ending.code, "signal": ending.signal, "reason": ending.reason, "hang": ending.hang}
