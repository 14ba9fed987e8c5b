"""`OnProcessStart`: what is done when a process has started."""

from __future__ import annotations

from typing import Any

from orchestra.compat.launch.actions.execute_process import ExecuteProcess
from orchestra.compat.launch.event_handlers.on_action_event_base import OnActionEventBase
from orchestra.compat.launch.events.process.process_started import ProcessStarted


class OnProcessStart(OnActionEventBase):
    """Wait until a process has started.

    `target_action` is its action, a predicate on actions, or None for any; `on_start` entities, or a callable that
    takes the event and the context and returns some.
    """

    def __init__(
        self,
        *,
        target_action: Any = None,
        on_start: Any,
        **kwargs: Any,
    ) -> None:
        super().__init__(
            action_matcher=target_action,
            on_event=on_start,
            target_event_cls=ProcessStarted,
            target_action_cls=ExecuteProcess,
            **kwargs,
        )
