"""A plan as a graph.

Namespaces are groups, processes, components and triggers are nodes, and what waits for what is an edge.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.plan.reactions import (
    ChangeStateAction,
    LoadAction,
    RegisterAction,
    SignalAction,
    StartAction,
    StopAction,
)
from orchestra.plan.render.drawing import Edge, Graph, Group, Node, at
from orchestra.plan.render.triggers import action_line, event_line

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.plan.model import Component, Plan, Process
    from orchestra.plan.reactions import Trigger, TriggeredAction
    from orchestra.plan.render.drawing import Shape


def graph(plan: Plan) -> Graph:
    """Return the graph of a plan, everything in plan order."""
    keys = {process.id: f"p{number}" for number, process in enumerate(plan.processes, 1)}
    keys |= {component.id: f"c{number}" for number, component in enumerate(plan.components, 1)}
    root = Group("/")
    outside = []
    for record, node in _nodes(plan, keys):
        if record.namespace is None:
            outside.append(node)
        else:
            at(root, record.namespace).nodes.append(node)
    triggers = [_trigger(number, trigger) for number, trigger in enumerate(plan.triggers, 1)]
    edges = [*_waits(plan, keys), *_held(plan, keys), *_reactions(plan, keys)]
    return Graph(plan.file, (*outside, *triggers), root, tuple(edges))


def _nodes(plan: Plan, keys: dict[str, str]) -> Iterator[tuple[Process | Component, Node]]:
    for process in plan.processes:
        what = f"{process.package}/{process.executable}" if process.package else process.executable
        shape: Shape = "node" if process.kind == "lifecycle_node" else process.kind
        yield process, Node(keys[process.id], shape, (process.id, what))
    for component in plan.components:
        lines = (component.id, f"{component.package}/{component.plugin}")
        yield component, Node(keys[component.id], "component", lines)


def _trigger(number: int, trigger: Trigger) -> Node:
    lines = (event_line(trigger), *(action_line(action) for action in trigger.do))
    return Node(f"t{number}", "trigger", lines)


def _waits(plan: Plan, keys: dict[str, str]) -> Iterator[Edge]:
    for process in plan.processes:
        for edge in process.depends_on:
            if edge.process in keys:
                yield Edge(keys[edge.process], keys[process.id], edge.condition)


def _held(plan: Plan, keys: dict[str, str]) -> Iterator[Edge]:
    for component in plan.components:
        if component.process in keys:
            yield Edge(keys[component.process], keys[component.id], "holds", dashed=True)


def _reactions(plan: Plan, keys: dict[str, str]) -> Iterator[Edge]:
    numbers = {trigger.id: f"t{number}" for number, trigger in enumerate(plan.triggers, 1)}
    for trigger in plan.triggers:
        own = numbers[trigger.id]
        if trigger.on.target in keys:
            yield Edge(keys[trigger.on.target], own, "", dashed=True)
        for action in trigger.do:
            for target in _targets(action):
                if target in keys or target in numbers:
                    word = action.action.replace("_", " ")
                    yield Edge(own, keys.get(target) or numbers[target], word, dashed=True)


def _targets(action: TriggeredAction) -> tuple[str, ...]:
    match action:
        case StartAction(process):
            return (process,)
        case LoadAction(component):
            return (component,)
        case StopAction(processes) | SignalAction(processes) | ChangeStateAction(processes):
            return processes
        case RegisterAction(trigger):
            return (trigger,)
    return ()
