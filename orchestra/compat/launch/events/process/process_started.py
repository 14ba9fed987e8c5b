"""`ProcessStarted`: a process runs."""

from __future__ import annotations

from orchestra.compat.launch.events.process.running_process_event import RunningProcessEvent


class ProcessStarted(RunningProcessEvent):
    """A process runs."""

    name = "launch.events.process.ProcessStarted"
