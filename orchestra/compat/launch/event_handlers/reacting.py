"""What the event handlers share that are given entities to visit, or a callable that returns some."""

from __future__ import annotations

from types import FunctionType
from typing import TYPE_CHECKING, Any

from orchestra.compat.building import models_of
from orchestra.compat.launch.event import Event
from orchestra.compat.launch.event_handler import BaseEventHandler, entities_of, is_of_ours
from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity
from orchestra.compat.wrong import WrongType

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.compat.launch.launch_context import LaunchContext

_GIVEN = 2
_ANY_NUMBER = 4  # `inspect.CO_VARARGS`, which is slow to import


class ReactingEventHandler(BaseEventHandler):
    """Visit entities, or call `reaction(event, context)` and visit what it returns. Raises `TypeError` for others."""

    _given_by_subclasses: tuple[str, ...] = ("matcher", "reaction")

    def __init__(self, *, matcher: Callable[[Any], bool], reaction: Any, **kwargs: Any) -> None:
        super().__init__(matcher=matcher, **kwargs)
        if type(reaction) is FunctionType:
            check_arguments(reaction, _GIVEN, "the event and the context")
        elif isinstance(reaction, type) and issubclass(reaction, Event | LaunchDescriptionEntity):
            name = reaction.__name__
            told_so = (
                f"actions or a function are expected here, this is the class {name}: brackets make an object"
            )
            raise WrongType(told_so, reaction)
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


def check_arguments(function: FunctionType, given: int, words: str) -> None:
    """Raise `WrongType` for a function that cannot be called with so many arguments, which are these."""
    code = function.__code__
    needed = code.co_argcount - len(function.__defaults__ or ())
    if needed > given or (code.co_argcount < given and not code.co_flags & _ANY_NUMBER):
        count = code.co_argcount
        told = f"{function.__name__} is called with {words}, it takes {count or 'no'} argument"
        raise WrongType(told + "s" * (count != 1), function)
