"""What a visit has come upon so far."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from orchestra.dataclass import dataclass
from orchestra.description.entity import Conditional
from orchestra.errors import Problems
from orchestra.fields import field
from orchestra.location import Location
from orchestra.resolve.context import Value
from orchestra.resolve.model import ResolvedArgument, ResolvedComponent, ResolvedProcess, ResolvedSkip
from orchestra.resolve.occasions import Occasion, Occasions


@dataclass(slots=True)
class Found:
    """What the visit has come upon so far.

    `lost` has the words of what has been left out for its faults: what depends on it is not reported. `endless` are
    the files that include themselves without end, which are not gone into again. `simulated_time` is where timers on
    ROS time were told to go by simulated time. `carried_out` are the objects of Python launch files that were visited,
    `kept` is the code of theirs that is called during the run. `triggers` have been settled so far, `positions` are
    those of each event handler among them, `timed` those of timers that may still be cancelled. `unmet` wait for
    processes that are not there. `choices` are those of arguments, of each declaration. `visited` are the identities of
    the actions with a condition that have been carried out, `doubts` what is wrong with those that were left out.
    `unpackaged` are programs that are nowhere and stand for nodes without a package. `stand_ins` are containers of ours
    of which it is still open whether they can be. `lets` are the variables that `let` has set, each with its place.
    `spawned` are the words of spawners of controllers.
    """

    processes: list[ResolvedProcess] = field(default_factory=list)
    components: list[ResolvedComponent] = field(default_factory=list)
    arguments: dict[str, ResolvedArgument] = field(default_factory=dict)
    occasions: Occasions = field(default_factory=Occasions)
    skipped: list[ResolvedSkip] = field(default_factory=list)
    lost: set[str] = field(default_factory=set)
    endless: set[str] = field(default_factory=set)
    simulated_time: Location | None = None
    carried_out: dict[int, Any] = field(default_factory=dict)
    kept: list[Any] = field(default_factory=list)
    triggers: int = 0
    positions: dict[int, list[int]] = field(default_factory=dict)
    timed: list[tuple[int, Occasion]] = field(default_factory=list)
    unmet: list[Occasion] = field(default_factory=list)
    choices: dict[str, set[tuple[str, ...] | None]] = field(default_factory=dict)
    visited: set[int] = field(default_factory=set)
    doubts: list[tuple[Conditional, Problems]] = field(default_factory=list)
    unpackaged: list[tuple[str, Location]] = field(default_factory=list)
    stand_ins: list[Any] = field(default_factory=list)
    lets: dict[str, Location] = field(default_factory=dict)
    spawned: list[Sequence[Value]] = field(default_factory=list)
    _by_origin: dict[int, list[int]] = field(default_factory=dict)
    _sorted: int = 0
    renewals: int = 0  # how often a process that was there has gone, or another one has taken its place

    def made_by(self, origin: object) -> tuple[int, ...]:
        """Return the processes that an object of a Python launch file has made."""
        for index in range(self._sorted, len(self.processes)):
            self._by_origin.setdefault(id(self.processes[index].origin), []).append(index)
        self._sorted = len(self.processes)
        return tuple(self._by_origin.get(id(origin), ()))

    def put_process(self, index: int, process: ResolvedProcess) -> None:
        """Put a process of the same object in the place of one."""
        self.processes[index] = process
        self.renewals += 1

    def drop_process(self) -> None:
        """Forget the process that has come last."""
        self.processes.pop()
        self.renewals += 1
        if len(self.processes) < self._sorted:
            self._by_origin.clear()
            self._sorted = 0

    @property
    def size(self) -> int:
        """A number that grows with everything that does more than set values."""
        return len(self.processes) + len(self.components) + len(self.occasions) + len(self.skipped)

    def choices_of(self, argument: str) -> tuple[str, ...] | None:
        """Return the values that an argument can have, None where any will do or declarations differ."""
        declared = self.choices.get(argument, ())
        return next(iter(declared)) if len(declared) == 1 else None
