"""`OnProcessExit`: what is done when a process has ended, each time where it is started again."""

from __future__ import annotations

from typing import Any

from orchestra.compat.launch.actions.execute_local import ExecuteLocal
from orchestra.compat.launch.event_handlers.on_action_event_base import OnActionEventBase
from orchestra.compat.launch.events.process.process_exited import ProcessExited


class OnProcessExit(OnActionEventBase):
    """Wait until a process has ended, each time where it is started again.

    `target_action` is its action, a predicate on actions, or None for any; `on_exit` entities, or a callable that
    takes the event and the context and returns some.
    """

    def __init__(
        self,
        *,
        target_action: Any = None,
        on_exit: Any,
        **kwargs: Any,
    ) -> None:
        super().__init__(
            action_matcher=target_action,
            on_event=on_exit,
            target_event_cls=ProcessExited,
            target_action_cls=ExecuteLocal,
            **kwargs,
        )
