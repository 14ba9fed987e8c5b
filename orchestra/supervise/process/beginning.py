"""Which processes begin when: the conditions they wait for, how long they do, and who is skipped in the end."""

from __future__ import annotations

import heapq
from functools import partial
from typing import TYPE_CHECKING

from orchestra.logs.names import shown
from orchestra.supervise.process import life, order
from orchestra.supervise.process.life import Phase

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from orchestra.plan.conditions import Dependency
    from orchestra.plan.model import Process
    from orchestra.supervise.loop import Timer
    from orchestra.supervise.process.unit import Unit
    from orchestra.supervise.surroundings import Listener, Surroundings

# Starting a program takes about a millisecond.
_MOST_AT_ONCE = 16
_PARTICIPLES = {"started": "started", "ready": "ready", "completed": "completed", "exited": "over"}


class Beginning:
    """Lets waiting processes begin.

    A process is looked at when it is new, and when something that it waits for has changed; in plan order.
    """

    def __init__(self, units: Mapping[str, Unit], surroundings: Surroundings, listener: Listener) -> None:
        self._units = units
        self._held: set[str] = set()
        self._around = surroundings
        self._listener = listener
        self._edge_timers: dict[tuple[str, Dependency], Timer] = {}
        self._waived: set[tuple[str, Dependency]] = set()
        self._names: list[str] = []
        self._ranks: dict[str, int] = {}
        self._dependents: dict[str, list[int]] = {}
        self._due: list[int] = []  # ranks, as a heap; some twice

    def add(self, processes: Iterable[Process]) -> None:
        """Take up processes, which wait from now on."""
        for process in processes:
            rank = self._ranks[process.id] = len(self._names)
            self._names.append(process.id)
            heapq.heappush(self._due, rank)
            for target in {edge.process for edge in process.depends_on}:
                self._dependents.setdefault(target, []).append(rank)

    def changed(self, process: str) -> None:
        """A process is in another phase: look at those that wait for it."""
        for rank in self._dependents.get(process, ()):
            heapq.heappush(self._due, rank)

    def hold(self, processes: Iterable[str]) -> None:
        """Only a trigger starts these."""
        self._held.update(processes)

    def holds(self, process: str) -> bool:
        """Tell whether a process waits for a trigger."""
        return process in self._held

    def prepare_tools(self, needed: Callable[[Unit], bool]) -> None:
        """Start the fork server and observers early: their imports take as long as those of a node."""
        self._around.starts.prepare(unit.process for unit in self._units.values())
        for unit in self._units.values():
            if needed(unit):
                try:
                    self._around.observers.prepare(self._around.environment(unit.process))
                except OSError as error:
                    self._listener.failed(f"the observer could not be started: {error}")

    def begin_or_skip(self) -> None:
        """Look at the waiting processes for which something has changed: each begins, waits on, or never will begin.

        Of many that begin together some are left for the next round, so that signals and output are seen to in between.
        """
        self._around.starts.relieve(self._units.values())
        begun = 0
        while self._due:
            if begun == _MOST_AT_ONCE:
                self._listener.again()
                return
            unit = self._units[self._names[heapq.heappop(self._due)]]
            if unit.state.phase is Phase.WAITING:
                begun += self._look_at(unit)

    def _look_at(self, unit: Unit) -> bool:
        """Tell whether it has begun."""
        fate = order.fate(self._edges(unit), _Standings(self._units))
        if fate.blocker:
            self._skip(unit, fate.blocker)
        elif unit.id in self._held:
            return False
        elif fate.begin:
            self._untime_edges(unit)
            unit.handle(life.Start())
        else:
            self._time_edges(unit, fate.awaited)
        return fate.begin

    def forget(self, unit: Unit) -> None:
        """Let a process begin without being waited for: somebody starts it by hand."""
        self._free(unit)

    def release(self, unit: Unit) -> None:
        """Let a process begin that only a trigger starts; one that has ended begins again, one that runs does not."""
        self._free(unit)
        if unit.over:
            unit.handle(life.Start())
        elif unit.state.phase is not Phase.WAITING:
            state = "was skipped" if unit.state.phase is Phase.SKIPPED else "has not ended"
            self._around.journal.say(f"{unit.name} is not started by a trigger: it {state}")

    def _free(self, unit: Unit) -> None:
        self._held.discard(unit.id)
        heapq.heappush(self._due, self._ranks[unit.id])

    def stop(self) -> None:
        """Nothing begins any more."""
        for timer in self._edge_timers.values():
            timer.cancel()

    def awaited(self, unit: Unit) -> list[str]:
        """Return what a waiting process waits for, in words."""
        if unit.id in self._held:
            return ["a trigger that starts it"]
        words = []
        for edge in self._edges(unit):
            target = self._units[edge.process]
            if order.reached(edge.condition, target.standing) is None:
                what = f" ({target.awaited})" if edge.condition == "ready" else ""
                words.append(f"{target.name} to be {_PARTICIPLES[edge.condition]}{what}")
        return words

    def _edges(self, unit: Unit) -> list[Dependency]:
        return [edge for edge in unit.process.depends_on if (unit.id, edge) not in self._waived]

    def _skip(self, unit: Unit, blocker: Dependency) -> None:
        target, condition = shown(blocker.process), _PARTICIPLES[blocker.condition]
        self._around.journal.say(f"{unit.name} is skipped: {target} will not be {condition} any more")
        self._untime_edges(unit)
        unit.handle(life.Skip())
        self._listener.skipped(unit.id)
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

    def _untime_edges(self, unit: Unit) -> None:
        """Stop the clocks of a process that waits no more, so that they wake nobody."""
        for edge in unit.process.depends_on:
            timer = self._edge_timers.pop((unit.id, edge), None)
            if timer:
                timer.cancel()

    def _edge_expired(self, unit: Unit, edge: Dependency) -> None:
        target = self._units[edge.process]
        if unit.state.phase is not Phase.WAITING or order.reached(edge.condition, target.standing):
            return
        condition = _PARTICIPLES[edge.condition]
        what = f" ({target.awaited})" if edge.condition == "ready" else ""
        reason = f"{unit.name} waited {edge.timeout:g} s for {target.name} to be {condition}{what}"
        if edge.required:
            self._listener.failed(reason, target.id)
        else:
            self._waived.add((unit.id, edge))
            heapq.heappush(self._due, self._ranks[unit.id])
            self._around.journal.say(f"{reason}; it is not required")
            self._listener.changed()


class _Standings:
    """How processes stand when somebody asks."""

    def __init__(self, units: Mapping[str, Unit]) -> None:
        self._units = units

    def __getitem__(self, process: str, /) -> order.Life:
        return self._units[process].standing
