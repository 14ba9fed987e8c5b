"""`event_named`: a matcher of event handlers."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.compat.launch.event import Event


def event_named(name: str) -> Callable[[Event], bool]:
    """Return the matcher that holds for events of a name, as `launch.events.Shutdown`."""

    def matches(event: Event) -> bool:
        return event.name == name

    return matches
