"""Actions that hold other actions or files, and the end of the run."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.frontend.reading.attributes import pairs, texts, value_or_text, values, variables

if TYPE_CHECKING:
    from orchestra.compat.launch.action import Action
    from orchestra.compat.launch.frontend.entity import Entity

_KEEP = "keep"


def group(entity: Entity, parser: Any, _ignored: frozenset[str]) -> dict[str, Any]:
    """Return the actions of a group, and what its scope lets through."""
    kept = variables(entity, parser, _KEEP)
    found = values(entity, {"scoped": bool, "forwarding": bool})
    if kept:
        found["launch_configurations"] = kept
    return {**found, "actions": _actions(entity, parser)}


def timer(entity: Entity, parser: Any, _ignored: frozenset[str]) -> dict[str, Any]:
    """Return a period and the actions that follow it."""
    entity.get_attr("period", data_type=float)  # raises where there is none
    return {
        **value_or_text(entity, parser, "period", float),
        **value_or_text(entity, parser, "cancel_on_shutdown", bool),
        "actions": _actions(entity, parser),
    }


def include(entity: Entity, parser: Any, _ignored: frozenset[str]) -> dict[str, Any]:
    """Return a file and its arguments, which newer releases spell `let`."""
    found = texts(entity, parser, {"file": "launch_description_source"})
    arguments = [*pairs(entity, parser, "arg"), *pairs(entity, parser, "let")]
    return {**found, "launch_arguments": arguments} if arguments else found


def log(entity: Entity, parser: Any, _ignored: frozenset[str]) -> dict[str, Any]:
    """Return a message."""
    return texts(entity, parser, {"message": "msg"})


def shutdown(entity: Entity, parser: Any, _ignored: frozenset[str]) -> dict[str, Any]:
    """Return the reason of an end."""
    return texts(entity, parser, {"reason": "reason"}, optional=True)


def _actions(entity: Entity, parser: Any) -> list[Action]:
    """Return the nested actions; in XML parts of the entity stand among them."""
    return [parser.parse_action(child) for child in entity.children if child.type_name != _KEEP]
