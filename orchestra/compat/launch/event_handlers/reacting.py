"""What the event handlers share that are given entities to visit, or a callable that returns some."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.building import models_of
from orchestra.compat.launch.event_handler import BaseEventHandler, entities_of, is_of_ours

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.compat.launch.event import Event
    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity


class ReactingEventHandler(BaseEventHandler):
    """Visit entities, or call `reaction(event, context)` and visit what it returns. Raises `TypeError` for others."""

    def __init__(self, *, matcher: Callable[[Any], bool], reaction: Any, **kwargs: Any) -> None:
        super().__init__(matcher=matcher, **kwargs)
        self.__function = reaction if callable(reaction) else None
        self.__entities = [] if callable(reaction) else entities_of(reaction)

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

    def _done(self) -> dict[str, Any]:
        """Return the fields of a model that say what is done."""
        if self.__function is not None or not is_of_ours(self, "handle"):
            return {"callback": self.handle}
        return {"children": models_of(self.__entities, self._place)}
