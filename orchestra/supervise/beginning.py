"""Which processes begin when: the conditions they wait for, how long they do, and who is skipped in the end."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from orchestra.logs.names import shown
from orchestra.supervise import life, order
from orchestra.supervise.life import Phase

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from orchestra.plan.model import Dependency
    from orchestra.supervise.loop import Timer
    from orchestra.supervise.surroundings import Listener, Surroundings
    from orchestra.supervise.unit import Unit

_PARTICIPLES = {"started": "started", "ready": "ready", "completed": "completed", "exited": "over"}


class Beginning:
    """Lets waiting processes begin. `held` are those that only a trigger starts."""

    def __init__(
        self, units: Mapping[str, Unit], held: Iterable[str], surroundings: Surroundings, listener: Listener
    ) -> None:
        self._units = units
        self._held = set(held)
        self._around = surroundings
        self._listener = listener
        self._edge_timers: dict[tuple[str, Dependency], Timer] = {}

    def prepare_observers(self) -> None:
        """Start observers early: their imports take as long as those of the nodes that are awaited."""
        for unit in self._units.values():
            if unit.awaits_message:
                try:
                    self._around.observers.prepare(self._around.environment(unit.process))
                except OSError as error:
                    self._listener.failed(f"the observer could not be started: {error}")

    def begin_or_skip(self) -> None:
        """Look at every waiting process: it begins, waits on, or never will begin."""
        standings = {name: unit.standing for name, unit in self._units.items()}
        for unit in self._units.values():
            if unit.state.phase is not Phase.WAITING:
                continue
            fate = order.fate(unit.process.depends_on, standings)
            if fate.blocker:
                self._skip(unit, fate.blocker)
            elif fate.begin and unit.id not in self._held:
                unit.handle(life.Start())
            elif unit.id not in self._held:
                self._time_edges(unit, fate.awaited)

    def release(self, unit: Unit) -> None:
        """Let a process begin that only a trigger starts; one that has ended begins again."""
        self._held.discard(unit.id)
        if unit.state.phase is not Phase.WAITING:
            unit.handle(life.Start())

    def stop(self) -> None:
        """Nothing begins any more."""
        for timer in self._edge_timers.values():
            timer.cancel()

    def _skip(self, unit: Unit, blocker: Dependency) -> None:
        target, condition = shown(blocker.process), _PARTICIPLES[blocker.condition]
        self._around.journal.say(f"{unit.name} is skipped: {target} will not be {condition} any more")
        unit.handle(life.Skip())
        if unit.process.required:
            reason = f"required process {unit.name} could not begin: {target} never was {condition}"
            self._listener.failed(reason)

    def _time_edges(self, unit: Unit, awaited: tuple[Dependency, ...]) -> None:
        """Start the clock of each edge: for a start with the run, for everything later with the start it follows."""
        for edge in awaited:
            begun = edge.condition == "started" or self._units[edge.process].state.starts > 0
            if edge.timeout is not None and begun and (unit.id, edge) not in self._edge_timers:
                self._edge_timers[unit.id, edge] = self._around.loop.call_later(
                    edge.timeout, partial(self._edge_expired, unit, edge)
                )

    def _edge_expired(self, unit: Unit, edge: Dependency) -> None:
        target = self._units[edge.process]
        if unit.state.phase is not Phase.WAITING or order.reached(edge.condition, target.standing):
            return
        condition = _PARTICIPLES[edge.condition]
        what = f" ({target.awaited})" if edge.condition == "ready" else ""
        reason = f"{unit.name} waited {edge.timeout:g} s for {target.name} to be {condition}{what}"
        self._listener.failed(reason, target.id)
