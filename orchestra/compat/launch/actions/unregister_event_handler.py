"""`UnregisterEventHandler`: lets an event handler wait no more."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.action import ModelledAction
from orchestra.description.actions.unregister_event_handler import UnregisterEventHandler as UnregisterModel

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.compat.launch.event_handler import BaseEventHandler
    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.description.entity import Action as Model


class UnregisterEventHandler(ModelledAction):
    """Let an event handler wait no more."""

    def __init__(self, event_handler: BaseEventHandler, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__event_handler = event_handler

    @property
    def event_handler(self) -> BaseEventHandler:
        """The event handler."""
        return self.__event_handler

    def execute(self, context: LaunchContext) -> None:
        """Let the event handler wait no more. Raises `ValueError` where it does not wait."""
        context.unregister_event_handler(self.event_handler)

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        return UnregisterModel.at(self._place.span, handler=self.event_handler, **common)
