"""The classes of what a bag may hold: messages, events of services, feedback of actions."""

from __future__ import annotations

from typing import Any, Final

from orchestra.ros.tools.messages.types import action_class, message_class, service_class

_EVENT: Final = "_Event"
_FEEDBACK: Final = "_FeedbackMessage"


def recorded_class(name: str) -> Any:  # noqa: ANN401 - a class of an untyped package
    """Return the class of a type that a topic may have. Raises `OrchestraError` where it is not here."""
    match name.split("/"):
        case [_, "srv", local] if local.endswith(_EVENT):
            return service_class(name.removesuffix(_EVENT)).Event
        case [_, "action", local] if local.endswith(_FEEDBACK):
            return action_class(name.removesuffix(_FEEDBACK)).Impl.FeedbackMessage
    return message_class(name)
