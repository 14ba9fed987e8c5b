"""`OnProcessIO`: what is done when a process reads or writes."""

from __future__ import annotations

from types import FunctionType
from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.actions.execute_local import ExecuteLocal
from orchestra.compat.launch.event_handler import entities_of, is_of_ours
from orchestra.compat.launch.event_handlers.on_action_event_base import OnActionEventBase
from orchestra.compat.launch.event_handlers.reacting import check_arguments
from orchestra.compat.launch.events.process.process_io import ProcessIO

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.description.handlers import Handler


class OnProcessIO(OnActionEventBase):
    """Wait for bytes of a process: each callable takes the event alone and may return entities.

    `target_action` is the process's action, a predicate on actions, or None for any.
    """

    def __init__(
        self,
        *,
        target_action: Any = None,
        on_stdin: Callable[[Any], Any] | None = None,
        on_stdout: Callable[[Any], Any] | None = None,
        on_stderr: Callable[[Any], Any] | None = None,
        **kwargs: Any,
    ) -> None:
        self.__target = target_action
        given = {"stdin": on_stdin, "stdout": on_stdout, "stderr": on_stderr}
        self.__functions = {name: value and _function(value) for name, value in given.items()}
        super().__init__(
            action_matcher=target_action,
            on_event=self.__called,
            target_event_cls=ProcessIO,
            target_action_cls=ExecuteLocal,
            **kwargs,
        )
        for name, value in given.items():
            if value and not callable(value):
                from orchestra.compat.refused_upstream import tell_no_function  # noqa: PLC0415 - few are that wrong

                tell_no_function(f"on_{name}", value, self._place)

    @property
    def handler_description(self) -> str:
        """Which streams are looked at."""
        return " ".join(f"on_{name}={function}" for name, function in self.__functions.items() if function)

    def __called(self, event: Any, context: LaunchContext) -> Any:  # noqa: ARG002 - as other handlers
        """Return what the callable of the stream returns."""
        for stream, function in self.__functions.items():
            if function is not None and getattr(event, f"from_{stream}"):
                return function(event)
        return None

    def _to_models(self) -> tuple[Handler, ...]:
        if not is_of_ours(self, "matches"):
            return super()._to_models()
        every = not is_of_ours(self, "handle")
        streams = [stream for stream, function in self.__functions.items() if every or function is not None]
        return tuple(
            self._model("process_output", target=self.__target, stream=stream, callback=self.handle)
            for stream in streams
        )


def _function(given: Any) -> Any:
    """Return a callable as it is, and one that returns the actions which are given in place of it."""
    if type(given) is FunctionType:
        check_arguments(given, 1, "the event")
    if callable(given):
        return given
    entities = entities_of(given)
    return lambda _: entities
