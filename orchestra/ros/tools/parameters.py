"""`param get`, `param set`, `param delete`, `param describe`."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from rcl_interfaces.msg import Parameter
from rcl_interfaces.srv import DescribeParameters, GetParameters, ListParameters, SetParameters

from orchestra.errors import RunError
from orchestra.nearest import nearest
from orchestra.ros.tools.graph.asking import Deadline, ask, node_there
from orchestra.ros.tools.graph.seeing import looking
from orchestra.ros.tools.parameter_values import (
    held,
    is_empty,
    json_value,
    label,
    retyped,
    type_name,
    value_of,
    value_of_text,
)
from orchestra.ros.tools.telling import tell

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Iterator, Sequence

    from orchestra.ros.tools.graph.seeing import Graph


class Asked:
    """The parameter services of a node, within one time."""

    def __init__(self, graph: Graph, node: str, deadline: Deadline) -> None:
        self.node = node
        self._graph = graph
        self._deadline = deadline

    def names(self) -> list[str]:
        """Return the names of all parameters."""
        answer = self._ask(ListParameters, "list_parameters", ListParameters.Request())
        return sorted(answer.result.names)

    def values(self, names: Sequence[str]) -> list[Any]:
        """Return the value of each parameter; one that is not declared has none."""
        answer = self._ask(GetParameters, "get_parameters", GetParameters.Request(names=list(names)))
        return list(answer.values)

    def descriptors(self, names: Sequence[str]) -> list[Any]:
        """Return the descriptor of each parameter."""
        request = DescribeParameters.Request(names=list(names))
        return list(self._ask(DescribeParameters, "describe_parameters", request).descriptors)

    def set(self, parameters: Sequence[Parameter]) -> list[Any]:
        """Set parameters, each on its own, and return what the node says to each.

        An empty list is of the type that the parameter has.
        """
        for one in filter(lambda one: is_empty(one.value), parameters):
            for present in self.values([one.name]):
                one.value = retyped(one.value, present)
        request = SetParameters.Request(parameters=list(parameters))
        name = f"{self.node}/set_parameters"
        answer = ask(
            *(self._graph, SetParameters, name, request, self._deadline),
            repeat=False,
            asking=lambda: self.values([]),
        )
        return list(answer.results)

    def _ask(self, kind: Any, service: str, request: Any) -> Any:  # noqa: ANN401 - untyped package
        return ask(self._graph, kind, f"{self.node}/{service}", request, self._deadline)


@contextmanager
def asked(options: Namespace) -> Iterator[Asked]:
    """Join the graph and find the node."""
    deadline = Deadline(options.timeout)
    with looking(options) as graph:
        yield Asked(graph, node_there(graph, options.node, deadline), deadline)


def get(options: Namespace) -> int:
    """Write the value of a parameter."""
    with asked(options) as node:
        values = node.values([options.name])
        # rclcpp answers nothing at all for a parameter that it has not.
        if not values or not values[0].type:
            _must_be_there(node, options.name)
    value = values[0] if values else value_of(None)
    there = held(value)
    shown = str(there) if options.hide_type else label(value) if there is None else f"{label(value)} {there}"
    data = {
        "node": node.node,
        "name": options.name,
        "type": type_name(value.type),
        "value": json_value(value),
    }
    tell(options, f"{shown}\n", data)
    return 0


def set_one(options: Namespace) -> int:
    """Set a parameter."""
    value = value_of_text(options.value)
    with asked(options) as node:
        result = _first(node.set([Parameter(name=options.name, value=value)]), options.name)
    because = f": {result.reason}" if result.reason else ""
    if not result.successful:
        raise RunError(f"Setting parameter failed{because}")
    tell(options, f"Set parameter successful{because}\n", _outcome(node, options.name, result))
    return 0


def delete(options: Namespace) -> int:
    """Undeclare a parameter."""
    with asked(options) as node:
        _must_be_there(node, options.name)
        result = _first(node.set([Parameter(name=options.name)]), options.name)
    because = f": {result.reason}" if result.reason else ""
    if not result.successful:
        raise RunError(f"Deleting parameter failed{because}")
    tell(options, f"Deleted parameter successfully{because}\n", _outcome(node, options.name, result))
    return 0


def describe(options: Namespace) -> int:
    """Write what a node says of parameters."""
    with asked(options) as node:
        for name in options.names:
            _must_be_there(node, name)
        descriptors = node.descriptors(options.names)
    tell(options, "".join(map(_description, descriptors)), [_described(one) for one in descriptors])
    return 0


def _must_be_there(node: Asked, name: str) -> None:
    """Raise `RunError` for a parameter that is not declared."""
    known = node.names()
    if name not in known:
        near = nearest(name, known)
        hint = f"; did you mean {near}?" if near else ""
        raise RunError(f"Parameter not set: {node.node} has no parameter {name}{hint}")


def _first(results: list[Any], name: str) -> Any:  # noqa: ANN401 - of an untyped package
    if not results:
        raise RunError(f"the node does not say whether {name} has changed")
    return results[0]


def _outcome(node: Asked, name: str, result: Any) -> dict[str, Any]:  # noqa: ANN401 - as above
    return {"node": node.node, "name": name, "successful": result.successful, "reason": result.reason}


def _description(descriptor: Any) -> str:  # noqa: ANN401 - as above
    rows = [f"Parameter name: {descriptor.name}", f"  Type: {type_name(descriptor.type)}"]
    if descriptor.description:
        rows.append(f"  Description: {descriptor.description}")
    rows.append("  Constraints:")
    if descriptor.read_only:
        rows.append("    Read only: true")
    for one in (*descriptor.integer_range, *descriptor.floating_point_range):
        rows += [f"    Min value: {one.from_value}", f"    Max value: {one.to_value}"]
        rows += [f"    Step: {one.step}"] if one.step else []
    if descriptor.additional_constraints:
        rows.append(f"    Additional constraints: {descriptor.additional_constraints}")
    return "".join(f"{row}\n" for row in rows)


def _described(descriptor: Any) -> dict[str, Any]:  # noqa: ANN401 - as above
    ranges = [*descriptor.integer_range, *descriptor.floating_point_range]
    return {
        "name": descriptor.name,
        "type": type_name(descriptor.type),
        "description": descriptor.description,
        "read_only": descriptor.read_only,
        "dynamic_typing": descriptor.dynamic_typing,
        "additional_constraints": descriptor.additional_constraints,
        "range": {"from": ranges[0].from_value, "to": ranges[0].to_value, "step": ranges[0].step}
        if ranges
        else None,
    }
