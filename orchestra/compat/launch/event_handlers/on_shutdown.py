"""`OnShutdown`: what is done when the run ends."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.building import models_of
from orchestra.compat.launch.event_handler import BaseEventHandler, entities_of, is_of_ours
from orchestra.compat.launch.events.shutdown import Shutdown

if TYPE_CHECKING:
    from orchestra.compat.launch.event import Event
    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity
    from orchestra.description.handlers import Handler


class OnShutdown(BaseEventHandler):
    """Wait for the end of the run.

    `on_shutdown` is entities, or a callable that takes the event and the context and returns some.
    """

    def __init__(self, *, on_shutdown: Any, **kwargs: Any) -> None:
        super().__init__(matcher=_is_shutdown, **kwargs)
        self.__function = on_shutdown if callable(on_shutdown) else None
        self.__entities = [] if callable(on_shutdown) else entities_of(on_shutdown)

    def handle(self, event: Event, context: LaunchContext) -> Any:
        """Return the entities, or what the callable returns."""
        super().handle(event, context)
        return self.__entities if self.__function is None else self.__function(event, context)

    def describe(self) -> tuple[str, list[LaunchDescriptionEntity]]:
        """Return what the handler is, and the entities that are known to follow."""
        return super().describe()[0], list(self.__entities)

    @property
    def handler_description(self) -> str:
        """What is done."""
        return "<actions>" if self.__function is None else f"{self.__function}"

    @property
    def matcher_description(self) -> str:
        """Which events are meant."""
        return "event issubclass of launch.events.Shutdown"

    def _to_models(self) -> tuple[Handler, ...]:
        if not is_of_ours(self, "matches"):
            return super()._to_models()
        if self.__function is not None or not is_of_ours(self, "handle"):
            return (self._model("shutdown", callback=self.handle),)
        return (self._model("shutdown", children=models_of(self.__entities, self._place)),)


def _is_shutdown(event: Any) -> bool:
    return isinstance(event, Shutdown)
