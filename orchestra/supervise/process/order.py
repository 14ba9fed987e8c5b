"""Who may begin, who never will, and who is stopped before whom."""

from __future__ import annotations

from itertools import accumulate
from typing import TYPE_CHECKING, NamedTuple, Protocol

from orchestra.supervise.process.life import FINAL, Phase
from orchestra.supervise.process.machine import succeeded
from orchestra.values import Stop

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from orchestra.plan.conditions import Dependency
    from orchestra.plan.model import Process
    from orchestra.supervise.process.life import Rules, State
    from orchestra.values import Condition

# After this time, in seconds, everything that is left is killed, unless a description asks for more.
DEADLINE = 5.0
# The last processes in the stop order are asked at the latest after this time, so that their own steps still fit into
# the deadline of the whole stop; and one level waits no longer than this for the one before.
_LAST_LEVEL_BY = 2.0
_LONGEST_LEVEL = 1.0
# Between the last step of a process and the deadline of all.
_MARGIN = 0.5


class Life(NamedTuple):
    """A process as the others see it."""

    rules: Rules
    state: State


class Lives(Protocol):
    """The processes, as the others see them, by id."""

    def __getitem__(self, process: str, /) -> Life:
        """Return how a process stands."""


class Fate(NamedTuple):
    """What becomes of a waiting process: exactly one of `begin` and `blocker` may be set, neither means to wait."""

    begin: bool = False
    blocker: Dependency | None = None
    awaited: tuple[Dependency, ...] = ()


def fate(dependencies: Iterable[Dependency], lives: Lives) -> Fate:
    """Judge a waiting process by what it depends on; what is not required is awaited only as long as it may come."""
    awaited = []
    for dependency in dependencies:
        holds = reached(dependency.condition, lives[dependency.process])
        if holds is False and dependency.required:
            return Fate(blocker=dependency)
        if holds is None:
            awaited.append(dependency)
    return Fate(begin=not awaited, awaited=tuple(awaited))


def reached(condition: Condition, life: Life) -> bool | None:
    """Tell whether a process has reached a condition: None for not yet, False for never.

    What an operator has ended may be started again, so it is not over for those who wait for more than its end.
    """
    state = life.state
    over = state.phase in (Phase.EXITED, Phase.FAILED)
    never = state.phase in FINAL and not state.halted
    if condition == "started":
        return state.starts > 0 or (False if never else None)
    if condition == "ready":
        return state.been_ready or (False if never else None)
    if condition == "exited":
        return over or (False if never else None)
    good = (
        state.phase is Phase.EXITED
        and not state.halted
        and state.ending is not None
        and succeeded(life.rules, state.ending)
    )
    return good or (False if never else None)


def stop_levels(processes: Iterable[Process]) -> dict[str, int]:
    """Return for each process when it is stopped: 0 for those on which nobody depends, then what they depend on."""
    from graphlib import TopologicalSorter  # noqa: PLC0415 - nothing is to be stopped yet when all begins

    needs = {process.id: [edge.process for edge in process.depends_on] for process in processes}
    levels = dict.fromkeys(needs, 0)
    for dependent in reversed([*TopologicalSorter(needs).static_order()]):
        for target in needs[dependent]:
            levels[target] = max(levels[target], levels[dependent] + 1)
    return levels


class Schedule(NamedTuple):
    """How a run ends: when each level is asked at the latest, and when all that is left is killed; seconds from now."""

    asked: tuple[float, ...]
    deadline: float


def schedule(levels: Mapping[str, int], stops: Mapping[str, Stop]) -> Schedule:
    """Plan the end of a run; `stops` are what the description says of single processes.

    Who writes a long time for a process means it: the level behind it waits as long, and the deadline comes after it.
    """
    deepest = max(levels.values(), default=0)
    usual = min(_LONGEST_LEVEL, _LAST_LEVEL_BY / deepest) if deepest else _LONGEST_LEVEL
    longest = dict.fromkeys(range(deepest + 1), usual)
    for process, stop in stops.items():
        longest[levels[process]] = max(longest[levels[process]], stop.timeout)
    asked = (0.0, *accumulate(longest[level] for level in range(deepest)))
    ends = [
        asked[levels[process]] + stop.timeout + stop.kill_timeout + _MARGIN for process, stop in stops.items()
    ]
    if asked[deepest] > usual * deepest:  # those who say nothing have been moved back
        ends.append(asked[deepest] + Stop().timeout + Stop().kill_timeout + _MARGIN)
    return Schedule(asked, max(DEADLINE, *ends) if ends else DEADLINE)
