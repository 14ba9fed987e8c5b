"""What holds for all nodes that follow in a scope."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.frontend.reading.attributes import texts

if TYPE_CHECKING:
    from orchestra.compat.launch.frontend.entity import Entity


def push_namespace(entity: Entity, parser: Any, _ignored: frozenset[str]) -> dict[str, Any]:
    """Return a namespace."""
    return texts(entity, parser, {"namespace": "namespace"})


def set_parameter(entity: Entity, parser: Any, _ignored: frozenset[str]) -> dict[str, Any]:
    """Return a parameter; a scalar is read by its looks when it is evaluated, a list here."""
    name = texts(entity, parser, {"name": "name"})
    if isinstance(entity._raw("value"), list):
        return {**name, "value": parser.parse_if_substitutions(entity.get_attr("value", data_type=None))}
    return {**name, **texts(entity, parser, {"value": "value"})}


def set_parameters_from_file(entity: Entity, parser: Any, _ignored: frozenset[str]) -> dict[str, Any]:
    """Return a parameter file."""
    return texts(entity, parser, {"filename": "filename"})


def set_remap(entity: Entity, parser: Any, _ignored: frozenset[str]) -> dict[str, Any]:
    """Return a remapping rule."""
    return texts(entity, parser, {"from": "src", "to": "dst"})


def set_log_dir(entity: Entity, parser: Any, _ignored: frozenset[str]) -> dict[str, Any]:
    """Return a folder for logs."""
    return texts(entity, parser, {"new_log_dir": "new_log_dir"})


def set_use_sim_time(entity: Entity, parser: Any, _ignored: frozenset[str]) -> dict[str, Any]:
    """Return whether the simulation tells the time."""
    return texts(entity, parser, {"value": "value"})
