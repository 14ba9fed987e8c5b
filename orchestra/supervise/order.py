"""Who may begin, who never will, and who is stopped before whom."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from orchestra.supervise.life import Phase
from orchestra.supervise.machine import succeeded

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from orchestra.plan.conditions import Dependency
    from orchestra.plan.model import Process
    from orchestra.supervise.life import Rules, State
    from orchestra.values import Condition

# The last processes in the stop order are asked at the latest after this time, so that their own steps still fit into
# the deadline of the whole stop; and one level waits no longer than this for the one before.
_LAST_LEVEL_BY = 2.0
_LONGEST_LEVEL = 1.0


class Life(NamedTuple):
    """A process as the others see it."""

    rules: Rules
    state: State


class Fate(NamedTuple):
    """What becomes of a waiting process: exactly one of `begin` and `blocker` may be set, neither means to wait."""

    begin: bool = False
    blocker: Dependency | None = None
    awaited: tuple[Dependency, ...] = ()


def fate(dependencies: Iterable[Dependency], lives: Mapping[str, Life]) -> Fate:
    """Judge a waiting process by what it depends on."""
    awaited = []
    for dependency in dependencies:
        holds = reached(dependency.condition, lives[dependency.process])
        if holds is False:
            return Fate(blocker=dependency)
        if holds is None:
            awaited.append(dependency)
    return Fate(begin=not awaited, awaited=tuple(awaited))


def reached(condition: Condition, life: Life) -> bool | None:
    """Tell whether a process has reached a condition: None for not yet, False for never."""
    state = life.state
    over = state.phase in (Phase.EXITED, Phase.FAILED)
    never = state.phase is Phase.SKIPPED or over
    if condition == "started":
        return state.starts > 0 or (False if never else None)
    if condition == "ready":
        return state.been_ready or (False if never else None)
    if condition == "exited":
        return over or (False if never else None)
    good = state.phase is Phase.EXITED and state.ending is not None and succeeded(life.rules, state.ending)
    return good or (False if never else None)


def stop_levels(processes: Iterable[Process]) -> dict[str, int]:
    """Return for each process when it is stopped: 0 for those on which nobody depends, then what they depend on."""
    needs = {process.id: [edge.process for edge in process.depends_on] for process in processes}
    levels = dict.fromkeys(needs, 0)
    # The plan has no cycles, so no chain is longer than the number of processes.
    for _ in needs:
        moved = False
        for dependent, targets in needs.items():
            for target in targets:
                if levels[target] <= levels[dependent]:
                    levels[target] = levels[dependent] + 1
                    moved = True
        if not moved:
            break
    return levels


def patience(levels: Iterable[int]) -> float:
    """Return how long, in seconds, one level of the stop order waits for the one before."""
    deepest = max(levels, default=0)
    return min(_LONGEST_LEVEL, _LAST_LEVEL_BY / deepest) if deepest else _LONGEST_LEVEL
