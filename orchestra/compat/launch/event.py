"""`launch.Event`: something that happens during a run."""

from __future__ import annotations

from orchestra.compat.refusing import Refusing


class Event(Refusing):
    """The base that users derive from; `name` tells kinds apart, with dots, as `launch.events.Shutdown`."""

    name = "launch.Event"
