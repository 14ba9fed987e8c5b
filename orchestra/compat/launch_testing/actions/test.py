"""`Test`: a program that tests."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.actions.emit_event import EmitEvent
from orchestra.compat.launch.actions.execute_process import ExecuteProcess
from orchestra.compat.launch.actions.timer_action import TimerAction
from orchestra.compat.launch.events.matchers import matches_action
from orchestra.compat.launch.events.process.shutdown_process import ShutdownProcess

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity
    from orchestra.compat.text import Sub


class Test(ExecuteProcess):
    """Start a program, which is stopped after `timeout` seconds, and killed `kill_timeout` seconds later."""

    __test__ = False  # pytest would collect it for its name

    def __init__(
        self, *, timeout: float | Sub | None = None, kill_timeout: float = 5.0, **kwargs: Any
    ) -> None:
        if timeout is not None:
            kwargs.setdefault("sigterm_timeout", str(kill_timeout))
        super().__init__(**kwargs)
        self._timeout = timeout

    @property
    def timeout(self) -> float | Sub | None:
        """Seconds until it is stopped, None: never."""
        return self._timeout

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Start the program; what follows stops it."""
        super().execute(context)
        if not self._timeout:
            return None
        period = float(self._timeout) if isinstance(self._timeout, int) else self._timeout
        stop = EmitEvent(event=ShutdownProcess(process_matcher=matches_action(self)))
        timer = TimerAction(period=period, actions=[stop])
        timer._place = stop._place = self._place
        return [timer]

    def _is_as_described(self) -> bool:
        return not self._timeout and super()._is_as_described()
