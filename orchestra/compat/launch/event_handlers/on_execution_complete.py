"""`OnExecutionComplete`: what is done when an action is done."""

from __future__ import annotations

from typing import Any

from orchestra.compat.launch.action import Action
from orchestra.compat.launch.event_handlers.on_action_event_base import OnActionEventBase
from orchestra.compat.launch.events.execution_complete import ExecutionComplete


class OnExecutionComplete(OnActionEventBase):
    """Wait until an action is done: a process has ended for good, any other one has been executed.

    `target_action` is the action, a predicate on actions, or None for any; `on_completion` entities, or a callable
    that takes the event and the context and returns some.
    """

    def __init__(
        self,
        *,
        target_action: Any = None,
        on_completion: Any,
        **kwargs: Any,
    ) -> None:
        super().__init__(
            action_matcher=target_action,
            on_event=on_completion,
            target_event_cls=ExecutionComplete,
            target_action_cls=Action,
            **kwargs,
        )
