"""Arguments, variables and environment variables."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.frontend.reading.attributes import ENTITIES, texts, value_or_text, variables

if TYPE_CHECKING:
    from orchestra.compat.launch.frontend.entity import Entity


def assignment(entity: Entity, parser: Any, _ignored: frozenset[str]) -> dict[str, Any]:
    """Return a name and a value."""
    return texts(entity, parser, {"name": "name", "value": "value"})


def removal(entity: Entity, parser: Any, _ignored: frozenset[str]) -> dict[str, Any]:
    """Return a name."""
    return texts(entity, parser, {"name": "name"})


def append_environment_variable(entity: Entity, parser: Any, ignored: frozenset[str]) -> dict[str, Any]:
    """Return a name and a value, and how it is appended."""
    return {
        **assignment(entity, parser, ignored),
        **value_or_text(entity, parser, "prepend", bool),
        **texts(entity, parser, {"separator": "separator"}, optional=True),
    }


def declaration(entity: Entity, parser: Any, _ignored: frozenset[str]) -> dict[str, Any]:
    """Return an argument; its name and its description are plain texts."""
    found: dict[str, Any] = {"name": parser.escape_characters(entity.get_attr("name"))}
    found |= texts(entity, parser, {"default": "default_value"}, optional=True)
    description = entity.get_attr("description", optional=True)
    if description is not None:
        found["description"] = parser.escape_characters(description)
    choices = entity.get_attr("choice", data_type=ENTITIES, optional=True)
    if choices:
        found["choices"] = [parser.escape_characters(choice.get_attr("value")) for choice in choices]
        for choice in choices:
            choice.assert_entity_completely_parsed()
    return found


def reset_configurations(entity: Entity, parser: Any, _ignored: frozenset[str]) -> dict[str, Any]:
    """Return the variables that are kept."""
    kept = variables(entity, parser, "keep")
    return {"launch_configurations": kept} if kept else {}
