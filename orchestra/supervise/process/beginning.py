"""Which processes begin when: the conditions they wait for, how long they do, and who is skipped in the end."""

from __future__ import annotations

import heapq
from functools import partial
from operator import itemgetter
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

    A process is looked at when it is new, and when something that it waits for has changed; in plan order. Of what it
    waits for only that is looked at then: it may be a thousand processes that end one by one.
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
        self._due: list[int] = []  # ranks, as a heap
        self._news: dict[int, set[str] | None] = {}  # what has changed for those that are due; None: anything
        self._open: dict[str, set[Dependency]] = {}  # what those that were looked at wait for still
        self._edges_to: dict[
            tuple[int, str], list[tuple[int, Dependency]]
        ] = {}  # with their places among all

    def add(self, processes: Iterable[Process]) -> None:
        """Take up processes, which wait from now on."""
        for process in processes:
            rank = self._ranks[process.id] = len(self._names)
            self._names.append(process.id)
            self._look_whole(rank)
            for place, edge in enumerate(process.depends_on):
                edges = self._edges_to.setdefault((rank, edge.process), [])
                if not edges:
                    self._dependents.setdefault(edge.process, []).append(rank)
                edges.append((place, edge))

    def changed(self, process: str) -> None:
        """A process is in another phase: look at those that wait for it."""
        for rank in self._dependents.get(process, ()):
            if rank not in self._news:
                self._news[rank] = {process}
                heapq.heappush(self._due, rank)
            elif (news := self._news[rank]) is not None:
                news.add(process)

    def _look_whole(self, rank: int) -> None:
        """Look at all that a process waits for."""
        if rank not in self._news:
            heapq.heappush(self._due, rank)
        self._news[rank] = None

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
            rank = heapq.heappop(self._due)
            unit, news = self._units[self._names[rank]], self._news.pop(rank)
            if unit.state.phase is Phase.WAITING:
                begun += self._look_at(unit, self._edges(unit, rank, news))
            else:
                self._open.pop(unit.id, None)

    def _look_at(self, unit: Unit, edges: list[Dependency]) -> bool:
        """Tell whether it has begun. `edges` are those that something has changed for since the last look."""
        fate = order.fate(edges, _Standings(self._units))
        if fate.blocker:
            self._skip(unit, fate.blocker)
            return False
        waiting = self._open.setdefault(unit.id, set())
        waiting.difference_update(edges)
        waiting.update(fate.awaited)
        if unit.id in self._held:
            return False
        if waiting:
            self._time_edges(unit, fate.awaited)
            return False
        self._untime_edges(unit)
        unit.handle(life.Start())
        return True

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
        self._look_whole(self._ranks[unit.id])

    def stop(self) -> None:
        """Nothing begins any more."""
        for timer in self._edge_timers.values():
            timer.cancel()

    def awaited(self, unit: Unit) -> list[str]:
        """Return what a waiting process waits for, in words."""
        if unit.id in self._held:
            return ["a trigger that starts it"]
        words = []
        for edge in self._edges(unit, self._ranks[unit.id], None):
            target = self._units[edge.process]
            if order.reached(edge.condition, target.standing) is None:
                what = f" ({target.awaited})" if edge.condition == "ready" else ""
                words.append(f"{target.name} to be {_PARTICIPLES[edge.condition]}{what}")
        return words

    def _edges(self, unit: Unit, rank: int, news: set[str] | None) -> list[Dependency]:
        """Return what a process waits for of those that have changed, in order; all where it was not looked at yet."""
        edges: Iterable[Dependency] = unit.process.depends_on
        if news is not None and unit.id in self._open:
            found = (edge for target in news for edge in self._edges_to[rank, target])
            edges = [edge for _, edge in sorted(found, key=itemgetter(0))]
        return [edge for edge in edges if (unit.id, edge) not in self._waived]

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
            self._look_whole(self._ranks[unit.id])
            self._around.journal.say(f"{reason}; it is not required")
            self._listener.changed()


class _Standings:
    """How processes stand when somebody asks."""

    def __init__(self, units: Mapping[str, Unit]) -> None:
        self._units = units

    def __getitem__(self, process: str, /) -> order.Life:
        return self._units[process].standing
