"""In which order a script starts processes, which waits where a run would do several things at once."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from orchestra.plan.model import Plan, Process


def in_order(plan: Plan) -> list[Process]:
    """Return the processes so that each follows what it waits for, else as in the plan."""
    places = {process.id: place for place, process in enumerate(plan.processes)}
    waiting_for = [
        {edge.process for edge in process.depends_on if edge.process in places} for process in plan.processes
    ]
    waiting: dict[str, list[int]] = {}
    for place, others in enumerate(waiting_for):
        for other in others:
            waiting.setdefault(other, []).append(place)
    lacking = [len(others) for others in waiting_for]
    free = [place for place, count in enumerate(lacking) if count == 0]
    ordered: list[int] = []
    while free:
        ordered += free
        after = [place for done in free for place in waiting.get(plan.processes[done].id, ())]
        for place in after:
            lacking[place] -= 1
        free = sorted({place for place in after if lacking[place] == 0})
    # In a circle, which is an error of the plan, any order is as good.
    ordered += [place for place, count in enumerate(lacking) if count]
    return [plan.processes[place] for place in ordered]
