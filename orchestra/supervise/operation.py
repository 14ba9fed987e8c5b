"""What an operator may ask of a running system: to see its processes, to start, stop, restart and signal them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.supervise.process import life
from orchestra.supervise.process.life import FINAL, LIVE, Phase

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from orchestra.supervise.process.beginning import Beginning
    from orchestra.supervise.process.stopping import Stopping
    from orchestra.supervise.process.unit import Unit
    from orchestra.supervise.surroundings import Surroundings


@dataclass(frozen=True, slots=True)
class Standing:
    """How a process stands. `uptime` is that of a program that runs, in seconds; `awaited` and `ending` are words.

    `awaited` is what it waits for, to begin or to be ready. `ending` is how its latest run ended. `starts` counts from
    1. `held`: only a trigger, or an operator, starts it.
    """

    id: str
    name: str
    kind: str
    phase: str
    pid: int | None
    starts: int
    uptime: float | None
    awaited: str | None
    ending: str | None
    required: bool
    executable: str
    held: bool


class Operation:
    """The operator's side of a running system; `end` ends it, for a reason."""

    def __init__(
        self,
        units: Mapping[str, Unit],
        beginning: Beginning,
        stopping: Stopping,
        surroundings: Surroundings,
        end: Callable[[str], None],
    ) -> None:
        self._units = units
        self._beginning = beginning
        self._stopping = stopping
        self._around = surroundings
        self._end = end

    @property
    def ending(self) -> bool:
        """Whether the run is coming to its end."""
        return self._stopping.begun

    def processes(self) -> list[Standing]:
        """Return how every process stands, in plan order."""
        return [self._standing(unit) for unit in self._units.values()]

    def unit(self, process: str) -> Unit:
        """Return a process itself. Raises `KeyError` where there is none of this id."""
        return self._units[process]

    def start(self, processes: Iterable[str]) -> dict[str, str | None]:
        """Start processes now, whatever they wait for; say for each why not, None where it does."""
        return {process: self._start(self._units[process]) for process in processes}

    def stop(self, processes: Iterable[str]) -> dict[str, str | None]:
        """End processes, which then stay down until somebody starts them; say for each why not."""
        return {process: self._stop(self._units[process]) for process in processes}

    def restart(self, processes: Iterable[str]) -> dict[str, str | None]:
        """End processes and start them anew; say for each why not."""
        return {process: self._restart(self._units[process]) for process in processes}

    def signal(self, processes: Iterable[str], number: int) -> dict[str, str | None]:
        """Send a signal; say for each process why not."""
        return {process: self._signal(self._units[process], number) for process in processes}

    def down(self, reason: str) -> None:
        """End the run."""
        self._end(reason)

    def _start(self, unit: Unit) -> str | None:
        phase = unit.state.phase
        if self._stopping.begun:
            return "the run is ending"
        if phase in (Phase.STARTING, Phase.RUNNING, Phase.READY):
            return "it runs already"
        self._tell(unit, "started")
        self._beginning.forget(unit)
        unit.handle(life.Renew() if phase is Phase.STOPPING else life.Start())
        return None

    def _stop(self, unit: Unit) -> str | None:
        if self._stopping.begun:
            return "the run is ending"
        if unit.state.phase in FINAL:
            return "it does not run"
        self._tell(unit, "stopped")
        unit.handle(life.Halt())
        return None

    def _restart(self, unit: Unit) -> str | None:
        if self._stopping.begun:
            return "the run is ending"
        if unit.state.phase is Phase.WAITING:
            return f"it has not begun: it waits for {'; '.join(self._beginning.awaited(unit))}"
        self._tell(unit, "restarted")
        unit.handle(life.Renew())
        return None

    def _signal(self, unit: Unit, number: int) -> str | None:
        if unit.pid is None or unit.state.phase not in LIVE:
            return "it does not run"
        unit.signal(number)
        return None

    def _tell(self, unit: Unit, what: str) -> None:
        self._around.journal.say(f"{unit.name} is {what} by an operator")

    def _standing(self, unit: Unit) -> Standing:
        state = unit.state
        runs = state.phase in LIVE and state.phase is not Phase.STARTING
        return Standing(
            id=unit.id,
            name=unit.name,
            kind=unit.process.kind,
            phase=state.phase.value,
            pid=unit.pid,
            starts=state.starts,
            uptime=self._around.loop.clock() - state.started_at if runs else None,
            awaited=self.awaited(unit),
            ending=str(state.ending) if state.ending else None,
            required=unit.process.required,
            executable=unit.process.executable,
            held=self._beginning.holds(unit.id),
        )

    def awaited(self, unit: Unit) -> str | None:
        """Return what a process waits for, in words; None where it waits for nothing."""
        if unit.state.phase is Phase.WAITING:
            return "; ".join(self._beginning.awaited(unit)) or None
        if unit.state.phase is Phase.RUNNING and unit.process.ready is not None:
            return unit.awaited
        return None
