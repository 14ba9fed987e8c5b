"""`OnShutdown`: what is done when the run ends."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.event_handler import is_of_ours
from orchestra.compat.launch.event_handlers.reacting import ReactingEventHandler
from orchestra.compat.launch.events.shutdown import Shutdown

if TYPE_CHECKING:
    from orchestra.description.handlers import Handler


class OnShutdown(ReactingEventHandler):
    """Wait for the end of the run.

    `on_shutdown` is entities, or a callable that takes the event and the context and returns some.
    """

    def __init__(self, *, on_shutdown: Any, **kwargs: Any) -> None:
        super().__init__(matcher=_is_shutdown, reaction=on_shutdown, **kwargs)

    @property
    def matcher_description(self) -> str:
        """Which events are meant."""
        return "event issubclass of launch.events.Shutdown"

    def _to_models(self) -> tuple[Handler, ...]:
        if not is_of_ours(self, "matches"):
            return super()._to_models()
        return (self._model("shutdown", **self._done()),)


def _is_shutdown(event: Any) -> bool:
    return isinstance(event, Shutdown)
