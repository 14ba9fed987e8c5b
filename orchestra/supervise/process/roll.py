"""Which processes keep a run going, take it with them, or need the observer: noted as they change.

Looking for them in every round would cost as much as there are processes, a thousand times in a run of a thousand.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.supervise.process.life import LIVE, Phase

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from orchestra.plan.model import Process
    from orchestra.plan.reactions import TriggeredAction
    from orchestra.supervise.process.unit import Unit

_LIVELY = frozenset({*LIVE, Phase.RESTARTING})
_SOON = frozenset({Phase.WAITING, Phase.STARTING, Phase.RESTARTING})


class Roll:
    """Knows it of all processes. `held` tells whether only a trigger starts one, `concerns` whether nodes in it do."""

    def __init__(
        self, units: Mapping[str, Unit], held: Callable[[str], bool], concerns: Callable[[Process], bool]
    ) -> None:
        self._units = units
        self._held = held
        self._concerns = concerns
        self._lively: set[str] = set()
        self._halted: set[str] = set()
        self._required: set[str] = set()
        self._observing: set[str] = set()
        self._unseen: set[str] = set()
        self._all_unseen = False

    def changed(self, process: str | None) -> None:
        """A process is in another phase, or something else has happened that may concern any of them."""
        if process is None:
            self._all_unseen = True
            return
        unit = self._units[process]
        halted = unit.state.halted
        _note(self._lively, process, wanted=unit.state.phase in _LIVELY)
        _note(self._halted, process, wanted=halted)
        _note(self._required, process, wanted=unit.process.required and unit.over and not halted)
        self._unseen.add(process)

    def carried_out(self, action: TriggeredAction) -> None:
        """An action has been carried out: what it does to a process is told by that, but for what it waited for."""
        if action.action == "start":
            self._unseen.add(action.process)
        elif action.action == "load":  # into a container that may be any of them
            self._all_unseen = True

    def keeps_on(self, *, ending: bool) -> bool:
        """Tell whether a process keeps the run from being over; one that an operator has ended may come back."""
        return bool(self._lively or (self._halted and not ending))

    @property
    def required_over(self) -> bool:
        """Whether a required process is over for good."""
        return bool(self._required)

    @property
    def needs_observer(self) -> bool:
        """Whether a process needs the observer, now or soon."""
        for process in self._units if self._all_unseen else self._unseen:
            _note(self._observing, process, wanted=self.observed(self._units[process]))
        self._all_unseen = False
        self._unseen.clear()
        return bool(self._observing)

    def observed(self, unit: Unit) -> bool:
        """Tell whether the observer will be needed for a process that is about to start, or is for its readiness."""
        soon = unit.state.phase in _SOON and not self._held(unit.id)
        return unit.awaits_message or (soon and self._concerns(unit.process))


def _note(members: set[str], process: str, *, wanted: bool) -> None:
    if wanted:
        members.add(process)
    else:
        members.discard(process)
