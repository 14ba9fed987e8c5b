"""`ShutdownProcess`: some processes are to end."""

from __future__ import annotations

from orchestra.compat.launch.events.process.process_targeted_event import ProcessTargetedEvent


class ShutdownProcess(ProcessTargetedEvent):
    """Some processes are to end, as at the end of the run."""

    name = "launch.events.process.ShutdownProcess"
