"""`launch.LaunchService`: for scripts that launch by themselves, and tests of launch files."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.events.include_launch_description import IncludeLaunchDescription
from orchestra.compat.launch.events.shutdown import Shutdown
from orchestra.compat.launch.launch_context import LaunchContext
from orchestra.compat.launch.logging import get_logger

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.compat.launch.event import Event
    from orchestra.compat.launch.launch_description import LaunchDescription


class LaunchService:
    """Visits launch descriptions in a state of its own: the configurations, the environment and what functions see.

    Processes are resolved but not started: while a launch file is loaded nothing runs.
    """

    def __init__(
        self,
        *,
        argv: Iterable[str] | None = None,
        noninteractive: bool = False,
        debug: bool = False,  # noqa: ARG002 - upstream's signature
    ) -> None:
        self.__context = LaunchContext(argv=argv, noninteractive=noninteractive)
        self.__waiting: list[Event] = []
        self.__running = False

    @property
    def context(self) -> LaunchContext:
        """What the descriptions see and change."""
        return self.__context

    @property
    def event_loop(self) -> None:
        """None: nothing runs in a loop."""
        return

    @property
    def task(self) -> None:
        """None: nothing runs in a loop."""
        return

    def include_launch_description(self, launch_description: LaunchDescription) -> None:
        """Let a description be visited by `run`."""
        self.emit_event(IncludeLaunchDescription(launch_description))

    def emit_event(self, event: Event) -> None:
        """Let an event happen in `run`, after those that wait already."""
        self.__waiting.append(event)

    def run(self, *, shutdown_when_idle: bool = True) -> int:
        """Return 0 when all events have been handled, 1 where something went wrong, which is logged.

        Raises `RuntimeError` outside the main thread, and where it runs already.
        """
        if threading.current_thread() is not threading.main_thread():
            raise RuntimeError("LaunchService.run is for the main thread")
        return self.__run(shutdown_when_idle=shutdown_when_idle)

    async def run_async(self, *, shutdown_when_idle: bool = True) -> int:
        """Return what `run` returns, in any thread."""
        return self.__run(shutdown_when_idle=shutdown_when_idle)

    def shutdown(self, force_sync: bool = False) -> None:  # noqa: ARG002 - upstream's signature
        """End the run where there is one."""
        if self.__running:
            self.emit_event(Shutdown(reason="LaunchService.shutdown() called"))

    def __run(self, *, shutdown_when_idle: bool) -> int:
        if self.__running:
            raise RuntimeError("this LaunchService runs already")
        self.__running = True
        try:
            self.__handle_events()
            if shutdown_when_idle and not self.context.is_shutdown:
                self.emit_event(Shutdown(reason="idle"))
                self.__handle_events()
        except Exception as error:  # noqa: BLE001 - as upstream: whatever code of the user raises ends the run
            get_logger("launch").error("Caught exception in launch: %s", error)
            return 1
        finally:
            self.__running = False
        return 0

    def __handle_events(self) -> None:
        engine: Any = self.context._engine
        while self.__waiting:
            event = self.__waiting.pop(0)
            if isinstance(event, IncludeLaunchDescription):
                engine.visit([event.launch_description])
            else:
                self.context._is_shutdown |= isinstance(event, Shutdown)
                engine.emit(event)
            engine.handle_events()
