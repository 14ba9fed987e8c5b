"""`OnActionEventBase`: event handlers for what happens to actions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.launch.event import Event
from orchestra.compat.launch.event_handler import is_of_ours
from orchestra.compat.launch.event_handlers.reacting import ReactingEventHandler
from orchestra.compat.launch.events.execution_complete import ExecutionComplete
from orchestra.compat.launch.events.process.process_exited import ProcessExited
from orchestra.compat.launch.events.process.process_io import ProcessIO
from orchestra.compat.launch.events.process.process_started import ProcessStarted
from orchestra.compat.launch.events.process.process_stderr import ProcessStderr
from orchestra.compat.launch.events.process.process_stdout import ProcessStdout
from orchestra.compat.wrong import WrongType

if TYPE_CHECKING:
    from orchestra.compat.launch.action import Action
    from orchestra.description.handlers import Handler

# What each event is in a plan: names, and fields of the model.
_EVENTS: Final[dict[type[Event], tuple[tuple[str, dict[str, str]], ...]]] = {
    ExecutionComplete: (("process_completed", {}),),
    ProcessExited: (("process_exited", {}),),
    ProcessIO: (("process_output", {"stream": "stdout"}), ("process_output", {"stream": "stderr"})),
    ProcessStarted: (("process_started", {}),),
    ProcessStderr: (("process_output", {"stream": "stderr"}),),
    ProcessStdout: (("process_output", {"stream": "stdout"}),),
}
_CUSTOM: Final[tuple[tuple[str, dict[str, str]], ...]] = (("custom", {}),)


class OnActionEventBase(ReactingEventHandler):
    """Wait for an event of a class whose `action` is the one that is meant.

    `action_matcher` is an action, a predicate on actions, or None for any; `on_event` entities, or a callable that
    takes the event and the context and returns some. Raises `TypeError` for anything else.
    """

    _given_by_subclasses = ("action_matcher", "on_event", "target_event_cls", "target_action_cls")
    _serves_code = False  # whether all that it does is for other code that may be called during the run

    def __init__(
        self,
        *,
        action_matcher: Any,
        on_event: Any,
        target_event_cls: type[Event],
        target_action_cls: type[Action],
        **kwargs: Any,
    ) -> None:
        if not (isinstance(target_event_cls, type) and issubclass(target_event_cls, Event)):
            raise WrongType(
                f"target_event_cls is a kind of event, not {target_event_cls!r}", path=("target_event_cls",)
            )
        _check_target(action_matcher, target_action_cls)
        super().__init__(matcher=self.__matches, reaction=on_event, **kwargs)
        self.__action_matcher = action_matcher
        self.__target_event_cls = target_event_cls
        self.__target_action_cls = target_action_cls

    @property
    def matcher_description(self) -> str:
        """Which events are meant."""
        event = f"event == {self.__target_event_cls.__name__}"
        if self.__action_matcher is None:
            return event
        return f"{event} and {self.__target_action_cls.__name__}(event.action)"

    def __matches(self, event: Any) -> bool:
        if not isinstance(event, self.__target_event_cls):
            return False
        target, action = self.__action_matcher, getattr(event, "action", None)
        if callable(target) and not isinstance(target, self.__target_action_cls):
            return bool(target(action))
        return target is None or action is target

    def _to_models(self) -> tuple[Handler, ...]:
        known = is_of_ours(self, "matches")
        events = _EVENTS.get(self.__target_event_cls, _CUSTOM) if known else _CUSTOM
        done = self._done()
        return tuple(
            self._model(event, target=self.__action_matcher, **fields, **done) for event, fields in events
        )


def _check_target(target: Any, kind: type[Action]) -> None:
    if target is not None and not isinstance(target, kind) and not callable(target):
        raise TypeError(f"the action to wait for is {kind.__name__} or a callable, not {target!r}")
