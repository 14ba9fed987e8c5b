"""Actions that Python code names by their objects, by the names that they have."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.convert.below import entities_below
from orchestra.description.actions.lifecycle_node import LifecycleNode
from orchestra.description.actions.load_composable_node import LoadComposableNode
from orchestra.description.actions.node import Node
from orchestra.description.actions.node_container import NodeContainer
from orchestra.description.actions.push_ros_namespace import PushRosNamespace
from orchestra.description.entity import Entity
from orchestra.description.parts import DependsOn
from orchestra.description.running import Running
from orchestra.description.text import Template, Words

if TYPE_CHECKING:
    from orchestra.convert.remarks import Remarks
    from orchestra.description.entity import Action


def named(actions: tuple[Action, ...], remarks: Remarks) -> tuple[Action, ...]:
    """Return the actions with names in place of objects, where a name says the same."""
    entities = tuple(entities_below(actions))
    processes = {id(entity.origin): entity for entity in entities if isinstance(entity, Running)}
    pushed = any(isinstance(entity, PushRosNamespace) for entity in entities)
    naming = _Naming(processes, remarks, pushed=pushed)
    found: tuple[Action, ...] = naming.of(actions)
    return found


class _Naming:
    """Puts names in place of objects."""

    def __init__(self, processes: dict[int, Running], remarks: Remarks, *, pushed: bool) -> None:
        self._processes = processes
        self._remarks = remarks
        self._pushed = pushed

    def of(self, value: Any) -> Any:  # noqa: ANN401 - a part of a description, whatever it is
        """Return an entity, or several, with names."""
        if isinstance(value, tuple):
            return tuple(map(self.of, value))
        if not isinstance(value, Entity):
            return value
        given = {name: getattr(value, name) for name in type(value).model_fields}
        updates = {name: self.of(item) for name, item in given.items() if isinstance(item, tuple)}
        if isinstance(value, LoadComposableNode) and value.target.action is not None:
            updates["target"] = self._full_name(value.target)
        elif isinstance(value, DependsOn) and value.process is not None and value.process.action is not None:
            updates |= self._dependency(value.process)
        elif isinstance(value, NodeContainer | LifecycleNode) and value.namespace is None:
            told = "the program itself decides on its namespace here: in the result it is the one around it"
            self._remarks.warn(told, value.span)
            updates["namespace"] = Template((), "", value.span)
        return value.model_copy(update=updates) if any(updates[n] != given[n] for n in updates) else value

    def _full_name(self, target: Template) -> Template:
        """Return the full name of a node; that of one below a namespace that is pushed is not known."""
        process = self._processes.get(id(target.action))
        if not isinstance(process, Node) or process.name is None:
            return target
        namespace = process.namespace
        constant = None if namespace is None else namespace.constant
        below = "" if constant is None else constant
        if self._pushed and not below.startswith("/"):
            return target
        slash = Words("" if below.endswith("/") else "/", target.span)
        parts = () if namespace is None else namespace.parts
        return Template((*parts, slash, *process.name.parts), "", target.span)

    def _dependency(self, target: Template) -> dict[str, Template | None]:
        process = self._processes.get(id(target.action))
        if isinstance(process, Node) and process.name is not None:
            full = self._full_name(target)
            return {"process": None, "node": process.name if full is target else full}
        return {"process": target if process is None or process.name is None else process.name}
