"""What the actions of triggers do to a running plan, besides telling something and asking the resolver."""

from __future__ import annotations

import signal
from typing import TYPE_CHECKING

from orchestra.plan.reactions import (
    CancelAction,
    ChangeStateAction,
    LoadAction,
    RegisterAction,
    ShutdownAction,
    SignalAction,
    StartAction,
    StopAction,
    UnregisterAction,
)
from orchestra.supervise.process import life
from orchestra.supervise.process.life import LIVE, Phase

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from orchestra.plan.reactions import TriggeredAction
    from orchestra.supervise.graph.nodes import Nodes
    from orchestra.supervise.process.beginning import Beginning
    from orchestra.supervise.process.unit import Unit
    from orchestra.supervise.reactions.triggers import Triggers


class Actions:
    """Carries out actions; `end` ends the run, for a reason."""

    def __init__(
        self,
        units: Mapping[str, Unit],
        beginning: Beginning,
        triggers: Triggers,
        nodes: Nodes,
        end: Callable[[str, str], None],
    ) -> None:
        self._units = units
        self._beginning = beginning
        self._triggers = triggers
        self._nodes = nodes
        self._end = end

    def carry_out(self, action: TriggeredAction) -> None:
        """Do it; what tells something or asks the resolver is none of these."""
        match action:
            case StartAction(process):
                self._beginning.release(self._units[process])
            case StopAction() | SignalAction():
                self._end_processes(action)
            case LoadAction(component):
                self._nodes.load(component)
            case ChangeStateAction(processes, transitions):
                self._nodes.change_state(processes, transitions)
            case RegisterAction(trigger):
                self._triggers.register(trigger)
            case UnregisterAction(trigger):
                self._triggers.unregister(trigger)
            case CancelAction(trigger):
                self._triggers.cancel(trigger)
            case ShutdownAction(reason):
                self._end(reason, f"shut down: {reason}")

    def _end_processes(self, action: StopAction | SignalAction) -> None:
        for process in action.processes:
            unit = self._units[process]
            if isinstance(action, SignalAction):
                unit.signal(signal.Signals[action.signal])
            else:
                self._stop(unit)

    def _stop(self, unit: Unit) -> None:
        """End a process that runs, or is about to; one that only a trigger starts may still be started."""
        phase = unit.state.phase
        waits = phase is Phase.WAITING and not self._beginning.holds(unit.id)
        if waits or phase is Phase.RESTARTING or phase in LIVE:
            unit.handle(life.StopRequested())
