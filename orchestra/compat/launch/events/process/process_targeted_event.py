"""`ProcessTargetedEvent`: an event for some of the processes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.event import Event
from orchestra.compat.launch.events.matchers import checked_matcher

if TYPE_CHECKING:
    from collections.abc import Callable


class ProcessTargetedEvent(Event):
    """The base of events for some of the processes; the matcher is a predicate on their actions."""

    name = "launch.events.process.ProcessTargetedEvent"

    def __init__(self, *, process_matcher: Callable[[Any], bool]) -> None:
        self.__process_matcher = checked_matcher("process_matcher", process_matcher)

    @property
    def process_matcher(self) -> Callable[[Any], bool]:
        """The predicate."""
        return self.__process_matcher
