"""`launch_testing.legacy`: tests as actions of a launch that is run by hand."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.actions.emit_event import EmitEvent
from orchestra.compat.launch.actions.register_event_handler import RegisterEventHandler
from orchestra.compat.launch.event_handlers.on_process_exit import OnProcessExit
from orchestra.compat.launch.events.shutdown import Shutdown
from orchestra.compat.launch_testing.running import belongs_to_running

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_description import LaunchDescription


class LaunchTestService:
    """Adds tests to a launch description, whose end ends the run. It does not run them itself."""

    def add_fixture_action(
        self, launch_description: LaunchDescription, action: Any, *, required: bool = False
    ) -> Any:
        """Add what tests need; where it is `required`, its end ends the run."""
        launch_description.add_action(action)
        if required:
            self._end_with(launch_description, action, f"{type(action).__name__} is required")
        return action

    def add_test_action(self, launch_description: LaunchDescription, action: Any) -> Any:
        """Add a test, whose end ends the run."""
        launch_description.add_action(action)
        self._end_with(launch_description, action, "the test is over")
        return action

    run = belongs_to_running("run")

    def _end_with(self, launch_description: LaunchDescription, action: Any, reason: str) -> None:
        end = EmitEvent(event=Shutdown(reason=reason))
        launch_description.add_action(
            RegisterEventHandler(OnProcessExit(target_action=action, on_exit=[end]))
        )
