"""`EmitEvent`: lets an event happen."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.explanation import told
from orchestra.compat.launch import events
from orchestra.compat.launch.action import Action, ModelledAction
from orchestra.compat.launch.event import Event
from orchestra.compat.wrong import WrongRuntime
from orchestra.description.actions.emit_event import EmitEvent as EmitEventModel

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.description.entity import Action as Model


class EmitEvent(ModelledAction):
    """Let an event happen after what is being visited; of a class of events, one that is made without arguments.

    Raises `RuntimeError` for anything but an event, `TypeError` for a class that wants arguments.
    """

    def __init__(self, *, event: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        if not (isinstance(event, Event) or (isinstance(event, type) and issubclass(event, Event))):
            raise WrongRuntime(_refusal(event), path=("event",))
        self.__event = event
        self.__emitted = event() if isinstance(event, type) else event

    @property
    def event(self) -> Any:
        """The event."""
        return self.__event

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        return EmitEventModel.at(self._place.span, event=self.__emitted, **common)


def _refusal(event: Any) -> str:
    """Return what to say of something that is no event."""
    if isinstance(event, Action):
        name = type(event).__name__
        also = f": the event is launch.events.{name}" if hasattr(events, name) else ""
        return f"EmitEvent takes an event, this is the action {name} of launch.actions{also}"
    return f"EmitEvent takes a launch.Event, not {told(event)}"
