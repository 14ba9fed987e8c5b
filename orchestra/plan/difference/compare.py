"""From two plans to their difference. Nothing is read, started or printed here."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.plan.codec import encode
from orchestra.plan.difference.model import Change, Difference, Fate, Item
from orchestra.plan.difference.values import changes, same

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.plan.model import Argument, Component, Plan, Process
    from orchestra.plan.reactions import Trigger

# A component is loaded anew where one of these differs; the rest concerns nobody but the supervisor.
_OF_THE_SUPERVISOR = frozenset({"lifecycle", "condition", "params_schema"})


def compare(before: Plan, after: Plan) -> Difference:
    """Return what would have to happen to a run of the first plan so that it becomes one of the second."""
    return Difference(
        tuple(_processes(before, after)),
        tuple(_components(before, after)),
        tuple(_triggers(before, after)),
        tuple(_arguments(before, after)),
    )


def _processes(before: Plan, after: Plan) -> Iterator[Item]:
    old = {process.id: process for process in before.processes}
    new = {process.id: process for process in after.processes}
    for identity, process in new.items():
        if identity not in old:
            yield Item(identity, "process", "start", (), process.location)
        else:
            yield from _process(old[identity], process)
    for identity, process in old.items():
        if identity not in new:
            yield Item(identity, "process", "stop", (), process.location)


def _process(before: Process, after: Process) -> Iterator[Item]:
    found = changes(before, after)
    if before.digest == after.digest:
        if found:
            yield Item(after.id, "process", "change", found, after.location)
        return
    if not found:  # one of them was made by another version, or changed by hand
        found = (Change("digest", None, before.digest, after.digest, before.location, after.location),)
    yield Item(after.id, "process", "restart", found, after.location)


def _components(before: Plan, after: Plan) -> Iterator[Item]:
    old = {component.id: component for component in before.components}
    new = {component.id: component for component in after.components}
    for identity, component in new.items():
        if identity not in old:
            yield Item(identity, "component", "start", (), component.location)
        else:
            yield from _component(old[identity], component)
    for identity, component in old.items():
        if identity not in new:
            yield Item(identity, "component", "stop", (), component.location)


def _component(before: Component, after: Component) -> Iterator[Item]:
    found = changes(before, after)
    if found:
        anew = any(change.field not in _OF_THE_SUPERVISOR for change in found)
        fate: Fate = "restart" if anew else "change"
        yield Item(after.id, "component", fate, found, after.location)


def _triggers(before: Plan, after: Plan) -> Iterator[Item]:
    """Yield the triggers that differ; their names are numbers, so they are told apart by what they do."""
    old, new = ({_done(trigger): trigger for trigger in plan.triggers} for plan in (before, after))
    for key, trigger in new.items():
        if key not in old:
            yield Item(trigger.id, "trigger", "start", (), trigger.location)
    for key, trigger in old.items():
        if key not in new:
            yield Item(trigger.id, "trigger", "stop", (), trigger.location)


def _done(trigger: Trigger) -> str:
    data = encode(trigger)
    numbered = trigger.id.startswith("t")
    left = {
        key: value for key, value in data.items() if key not in ("location", *(("id",) if numbered else ()))
    }
    left["do"] = [{key: value for key, value in action.items() if key != "location"} for action in data["do"]]
    return repr(left)


def _arguments(before: Plan, after: Plan) -> Iterator[Item]:
    old = {argument.name: argument for argument in before.arguments if not argument.given}
    new = {argument.name: argument for argument in after.arguments if not argument.given}
    for name, argument in new.items():
        if name not in old:
            yield Item(name, "argument", "start", (), argument.location)
        elif not same(*(_said(item) for item in (old[name], argument))):
            yield Item(name, "argument", "change", tuple(_argument(old[name], argument)), argument.location)
    for name, argument in old.items():
        if name not in new:
            yield Item(name, "argument", "stop", (), argument.location)


def _said(argument: Argument) -> tuple[object, ...]:
    return argument.value, argument.default, argument.choices, argument.description


def _argument(before: Argument, after: Argument) -> Iterator[Change]:
    for field in ("value", "default", "choices", "description"):
        one, other = getattr(before, field), getattr(after, field)
        if not same(one, other):
            yield Change(field, None, encode(one), encode(other), before.location, after.location)
