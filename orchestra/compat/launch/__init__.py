"""What launch files import as `launch`."""

from __future__ import annotations

from typing import Any

from orchestra.compat.lazy import exported

_NAMES = {
    "Action": "action",
    "Condition": "condition",
    "Event": "event",
    "EventHandler": "event_handler",
    "InvalidLaunchFileError": "invalid_launch_file_error",
    "LaunchContext": "launch_context",
    "LaunchDescription": "launch_description",
    "LaunchDescriptionEntity": "launch_description_entity",
    "LaunchDescriptionSource": "launch_description_source",
    "LaunchIntrospector": "launch_introspector",
    "LaunchService": "launch_service",
    "SomeActionsType": "some_actions_type",
    "SomeActionsType_types_tuple": "some_actions_type",
    "SomeEntitiesType": "some_entities_type",
    "SomeEntitiesType_types_tuple": "some_entities_type",
    "SomeSubstitutionsType": "some_substitutions_type",
    "SomeSubstitutionsType_types_tuple": "some_substitutions_type",
    "Substitution": "substitution",
    "actions": "",
    "conditions": "",
    "descriptions": "",
    "event_handlers": "",
    "events": "",
    "frontend": "",
    "launch_description_sources": "",
    "logging": "",
    "substitutions": "",
    "utilities": "",
}

__all__ = sorted(_NAMES)  # noqa: PLE0605 - the names are those of the table

_attribute = exported(__name__, _NAMES)


def __getattr__(name: str) -> Any:
    return _attribute(name)
