"""`RegisterEventHandler`: lets an event handler wait for its event."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.explanation import told
from orchestra.compat.launch.action import ModelledAction
from orchestra.compat.launch.event_handler import BaseEventHandler
from orchestra.compat.wrong import WrongType
from orchestra.description.actions.register_event_handler import RegisterEventHandler as RegisterModel

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity
    from orchestra.description.entity import Action as Model


class RegisterEventHandler(ModelledAction):
    """Let an event handler wait, before those that wait already. Raises `TypeError` for anything else."""

    def __init__(self, event_handler: BaseEventHandler, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        if not isinstance(event_handler, BaseEventHandler):
            raise WrongType(
                f"RegisterEventHandler takes an event handler, this is {told(event_handler)}",
                path=("event_handler",),
            )
        self.__event_handler = event_handler

    @property
    def event_handler(self) -> BaseEventHandler:
        """The event handler."""
        return self.__event_handler

    def describe_conditional_sub_entities(self) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return the entities that are known to follow from the event."""
        text, entities = self.event_handler.describe()
        return [(text, entities)] if entities else []

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        handlers = self.event_handler._to_models()
        return RegisterModel.at(self._place.span, handlers=handlers, **common)
