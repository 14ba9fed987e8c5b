"""Which processes of a run are up, decided from its plan and its events."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.nearest import nearest
from orchestra.supervise.reactions.triggers import held

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.events import Event
    from orchestra.plan.model import Plan, Process


@dataclass(frozen=True, slots=True)
class Standing:
    """Of the processes that are asked about: which are not up yet, and which will never be, with the reason."""

    pending: tuple[str, ...]
    lost: tuple[str, ...]


def standing(plan: Plan, events: Iterable[Event], names: Iterable[str]) -> Standing:
    """Judge the named processes, or all that start with the run.

    A process with a `ready` condition is up when it has been met, any other when its program runs.
    """
    asked = [identity(plan, name) for name in names] or _starting_with_the_run(plan)
    up_by = {process.id: _up_by(process) for process in plan.processes}
    up, lost = set(), dict[str, str]()
    for event in events:
        if event.process is None:
            continue
        if event.kind in up_by.get(event.process, ()):
            up.add(event.process)
        elif event.kind in ("process_failed", "process_skipped"):
            lost[event.process] = (
                f"{event.process} {event.kind.removeprefix('process_')}: {event.cause or event.data}"
            )
    pending = [process for process in asked if process not in up]
    return Standing(tuple(pending), tuple(lost[process] for process in pending if process in lost))


def identity(plan: Plan, name: str) -> str:
    """Return the plan id that a name means: the id itself, or the same with a slash in front.

    Raises `LookupError` where the plan has no such process.
    """
    known = [process.id for process in plan.processes]
    for candidate in (name, f"/{name}"):
        if candidate in known:
            return candidate
    near = nearest(name, known)
    hint = f"did you mean {near}?" if near else f"there are {', '.join(known)}"
    raise LookupError(f"the plan has no process {name}; {hint}")


def _up_by(process: Process) -> tuple[str, ...]:
    return ("process_ready",) if process.ready else ("process_running", "process_ready", "process_exited")


def _starting_with_the_run(plan: Plan) -> list[str]:
    triggered = held(plan.triggers)
    return [process.id for process in plan.processes if process.id not in triggered]
