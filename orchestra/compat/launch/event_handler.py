"""`launch.EventHandler`: what is done whenever a certain event comes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from orchestra.compat.building import models_of
from orchestra.compat.explanation import told
from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity
from orchestra.compat.place import here
from orchestra.compat.refusing import Refusing
from orchestra.compat.wrong import WrongType
from orchestra.description.handlers import Handler

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.compat.launch.event import Event
    from orchestra.compat.launch.launch_context import LaunchContext


class BaseEventHandler(Refusing):
    """The base of all event handlers: users derive from it and write `handle(event, context)`.

    With `handle_once` it waits no more after the first event.
    """

    def __init__(self, *, matcher: Callable[[Any], bool], handle_once: bool = False) -> None:
        self.__matcher = matcher
        self.__handle_once = handle_once
        self._place = here(self)

    @property
    def handle_once(self) -> bool:
        """Whether it handles one event only."""
        return self.__handle_once

    @property
    def handler_description(self) -> str | None:
        """What is done."""
        return None

    @property
    def matcher_description(self) -> str | None:
        """Which events are meant."""
        return None

    def describe(self) -> tuple[str, list[LaunchDescriptionEntity]]:
        """Return what the handler is, and the entities that are known to follow."""
        text = (
            f"{type(self).__name__}(matcher='{self.matcher_description}', "
            f"handler='{self.handler_description}', handle_once={self.handle_once})"
        )
        return text, []

    def matches(self, event: Event) -> bool:
        """Return whether the event is one to handle."""
        return self.__matcher(event)

    def handle(self, event: Event, context: LaunchContext) -> Any:
        """Make the event known as `context.locals.event`; return what is to be visited. Here: nothing."""
        context.extend_locals({"event": event})
        if self.handle_once:
            context.unregister_event_handler(self)

    def _to_models(self) -> tuple[Handler, ...]:
        """Return what a plan can know about the handler: one model per kind of event."""
        return (self._model("custom", callback=self.handle),)

    def _model(self, event: str, **values: Any) -> Handler:
        return Handler.at(self._place.span, origin=self, event=event, once=self.handle_once, **values)


class EventHandler(BaseEventHandler):
    """An event handler that has the same entities visited each time."""

    def __init__(
        self,
        *,
        matcher: Callable[[Any], bool],
        entities: LaunchDescriptionEntity | Iterable[LaunchDescriptionEntity] | None = None,
        handle_once: bool = False,
    ) -> None:
        super().__init__(matcher=matcher, handle_once=handle_once)
        self.__entities = entities

    @property
    def entities(self) -> Any:
        """The entities, as they were given."""
        return self.__entities

    def describe(self) -> tuple[str, list[LaunchDescriptionEntity]]:
        """Return what the handler is, and its entities."""
        return super().describe()[0], entities_of(self.entities)

    def handle(self, event: Event, context: LaunchContext) -> Any:
        """Return the entities."""
        super().handle(event, context)
        return self.entities

    def _to_models(self) -> tuple[Handler, ...]:
        if not is_of_ours(self, "handle"):
            return super()._to_models()
        return (self._model("custom", children=models_of(entities_of(self.entities), self._place)),)


def entities_of(entities: Any) -> list[LaunchDescriptionEntity]:
    """Return one or more entities as a list. Raises `TypeError` for anything else."""
    if entities is None:
        return []
    listed = [entities] if isinstance(entities, LaunchDescriptionEntity) else entities
    if not isinstance(listed, Iterable) or isinstance(listed, str):
        raise WrongType(f"an event handler has a list of actions, not {_misplaced(entities)}", entities)
    found = list(listed)
    for entity in found:
        if not isinstance(entity, LaunchDescriptionEntity):
            raise WrongType(
                f"an event handler has actions and other entities, not {_misplaced(entity)}", entity
            )
    return found


def _misplaced(given: Any) -> str:
    from orchestra.compat.misplaced import taken_by  # noqa: PLC0415 - only mistakes need it

    return f"{told(given)}{taken_by(given)}"


def is_of_ours(entity: object, method: str) -> bool:
    """Return whether no subclass of a user has a method of its own."""
    function: Any = getattr(type(entity), method)
    return bool(function.__module__.startswith("orchestra.compat."))
