"""Nodes, containers and components."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.frontend.parse_substitution import Given
from orchestra.compat.launch.frontend.reading.attributes import (
    ENTITIES,
    condition,
    pairs,
    texts,
    value_or_text,
)
from orchestra.compat.launch.frontend.reading.parameters import parameters
from orchestra.compat.launch.frontend.reading.processes import execute_process
from orchestra.compat.launch.frontend.reading.words import words
from orchestra.compat.launch_ros.descriptions import ComposableNode

if TYPE_CHECKING:
    from orchestra.compat.launch.frontend.entity import Entity

_OPTIONAL = {"pkg": "package", "name": "name", "namespace": "namespace", "exec_name": "exec_name"}
_INSTEAD = {"module": "module", "script": "script"}
_WORDS = {"args": "arguments", "ros_args": "ros_arguments"}
_REQUIRED_OF_COMPONENT = {"pkg": "package", "plugin": "plugin"}
_OPTIONAL_OF_COMPONENT = {"name": "name", "namespace": "namespace"}


def node(entity: Entity, parser: Any, ignored: frozenset[str]) -> dict[str, Any]:
    """Return a node and how it is run."""
    found = execute_process(entity, parser, ignored | {"cmd", "name"})
    other = texts(entity, parser, _INSTEAD, optional=True)
    found |= other | texts(entity, parser, {"exec": "executable"}, optional=bool(other))
    found |= texts(entity, parser, _OPTIONAL, optional=True)
    for name, keyword in _WORDS.items():
        given = words(entity, name, parser, optional=True)
        if given is not None:
            found[keyword] = given
    return found | _settings(entity, parser)


def lifecycle_node(entity: Entity, parser: Any, ignored: frozenset[str]) -> dict[str, Any]:
    """Return a lifecycle node, which newer releases may start by itself."""
    return {**node(entity, parser, ignored), **value_or_text(entity, parser, "autostart", bool)}


def container(entity: Entity, parser: Any, ignored: frozenset[str]) -> dict[str, Any]:
    """Return a container with its components."""
    found = node(entity, parser, ignored)
    components = _components(entity, parser, optional=True)
    return {**found, "composable_node_descriptions": components} if components else found


def load_composable_nodes(entity: Entity, parser: Any, _ignored: frozenset[str]) -> dict[str, Any]:
    """Return a container's name and the components for it."""
    found = texts(entity, parser, {"target": "target_container"})
    return {**found, "composable_node_descriptions": _components(entity, parser, optional=False)}


def composable_node(entity: Entity, parser: Any) -> dict[str, Any]:
    """Return a component."""
    found = condition(entity, parser) | texts(entity, parser, _REQUIRED_OF_COMPONENT)
    found |= texts(entity, parser, _OPTIONAL_OF_COMPONENT, optional=True)
    found |= _settings(entity, parser)
    extra = pairs(entity, parser, "extra_arg")
    if extra:
        found["extra_arguments"] = [{tuple(name): value} for name, value in extra]
    return found


def _settings(entity: Entity, parser: Any) -> dict[str, Any]:
    """Return remappings and parameters."""
    found: dict[str, Any] = {}
    rules = pairs(entity, parser, "remap", "from", "to")
    if rules:
        found["remappings"] = rules
    params = entity.get_attr("param", data_type=ENTITIES, optional=True)
    if params:
        found["parameters"] = parameters(params, parser)
    return found


def _components(entity: Entity, parser: Any, *, optional: bool) -> list[ComposableNode]:
    found = []
    for item in entity.get_attr("composable_node", data_type=ENTITIES, optional=optional) or ():
        made = ComposableNode(**composable_node(item, parser))
        item.assert_entity_completely_parsed()
        if item._span is not None:
            made._place = Given(item._span)
        found.append(made)
    return found
