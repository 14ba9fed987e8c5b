"""What a deferred trigger adds to a plan, as the resolver answers it, and whether it fits."""

from __future__ import annotations

import json
from collections import Counter
from graphlib import CycleError, TopologicalSorter
from typing import TYPE_CHECKING, Any

from orchestra.dataclass import dataclass
from orchestra.errors import Problem, Severity
from orchestra.fields import replace
from orchestra.location import Location
from orchestra.plan import codec
from orchestra.plan.model import Component, Process
from orchestra.plan.reactions import (
    CancelAction,
    ChangeStateAction,
    LoadAction,
    RegisterAction,
    SignalAction,
    StartAction,
    StopAction,
    Trigger,
    TriggeredAction,
    UnregisterAction,
)

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from orchestra.plan.model import Plan


@dataclass(frozen=True, slots=True)
class Fragment:
    """Records to add to the plan of a run, and what is done at once."""

    processes: tuple[Process, ...]
    components: tuple[Component, ...]
    triggers: tuple[Trigger, ...]
    do: tuple[TriggeredAction, ...]
    problems: tuple[Problem, ...]


@dataclass(frozen=True, slots=True)
class Failure:
    """Why there is none; `location` where the resolver knows a better one than that of the trigger.

    `abandoned` says that nothing went wrong: the answer was not awaited, since the run ended.
    """

    reason: str
    location: Location | None = None
    abandoned: bool = False


_NOTHING: dict[str, Any] = {"processes": [], "components": [], "triggers": [], "do": [], "problems": []}


def loads(line: bytes) -> Fragment | Failure:
    """Read an answer of the resolver."""
    try:
        answer = json.loads(line)
        if "failure" in answer:
            return codec.decode(  # type: ignore[no-any-return] # what it decodes is what it is given
                Failure, {"reason": answer["failure"], "location": answer.get("location"), "abandoned": False}
            )
        return _read({**_NOTHING, **answer})
    except (ValueError, KeyError, TypeError, AttributeError, IndexError) as error:
        return Failure(f"this is a bug in Orchestra: the resolver answered no fragment of a plan: {error!r}")


def _read(answer: dict[str, Any]) -> Fragment | Failure:
    if unknown := answer.keys() - _NOTHING:
        raise ValueError(f"unknown: {', '.join(sorted(unknown))}")
    fragment: Fragment = codec.decode(Fragment, answer)
    errors = [problem for problem in fragment.problems if problem.severity is Severity.ERROR]
    if errors:
        first = errors[0]
        more = f", and {len(errors) - 1} more" if len(errors) > 1 else ""
        place = Location(first.span, first.included_from) if first.span else None
        return Failure(f"{first.message}{more}", place)
    return fragment


def merged(plan: Plan, fragment: Fragment) -> tuple[Plan, str | None]:
    """Return the plan with the fragment's records at its ends, and what is wrong with that, if anything is."""
    whole = replace(
        plan,
        processes=plan.processes + fragment.processes,
        components=plan.components + fragment.components,
        triggers=plan.triggers + fragment.triggers,
    )
    return whole, next(_faults(whole, fragment), None)


def _faults(whole: Plan, fragment: Fragment) -> Iterator[str]:
    """Yield what is wrong with the part of a plan that is new."""
    for kind, records in (
        ("process", whole.processes),
        ("component", whole.components),
        ("trigger", whole.triggers),
    ):
        counted = Counter(record.id for record in records)
        yield from (f"there are two {kind} records {name}" for name, count in counted.items() if count > 1)
    known = {
        "process": {process.id for process in whole.processes},
        "component": {component.id for component in whole.components},
        "trigger": {trigger.id for trigger in whole.triggers},
    }
    for kind, name in _references(fragment):
        places = (known["process"] | known["component"]) if kind == "node" else known[kind]
        if name not in places:
            yield f"there is no {kind} {name}"
    yield from _cycle(whole)


def _references(fragment: Fragment) -> Iterator[tuple[str, str]]:
    """Yield what the records speak of; a `node` is a process or a component."""
    for process in fragment.processes:
        yield from (("process", edge.process) for edge in process.depends_on)
    yield from (("process", item.process) for item in fragment.components if item.process is not None)
    for trigger in fragment.triggers:
        if trigger.on.target is not None:
            yield "node", trigger.on.target
        yield from _spoken_of(trigger.do)
    yield from _spoken_of(fragment.do)


def _spoken_of(actions: Iterable[TriggeredAction]) -> Iterator[tuple[str, str]]:
    for action in actions:
        match action:
            case StartAction(process):
                yield "process", process
            case LoadAction(component):
                yield "component", component
            case StopAction(processes) | SignalAction(processes):
                yield from (("process", process) for process in processes)
            case ChangeStateAction(processes):
                yield from (("node", process) for process in processes)
            case RegisterAction(trigger) | UnregisterAction(trigger) | CancelAction(trigger):
                yield "trigger", trigger


def _cycle(whole: Plan) -> Iterator[str]:
    try:
        TopologicalSorter(
            {process.id: [edge.process for edge in process.depends_on] for process in whole.processes}
        ).prepare()
    except CycleError as error:
        yield f"dependencies in a circle: {' -> '.join(reversed(error.args[1]))}"
