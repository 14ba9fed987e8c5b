"""What the parts of a running system share."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from orchestra.logs.journal import Journal
from orchestra.plan.model import Process
from orchestra.supervise.kin import Kin
from orchestra.supervise.loop import Loop
from orchestra.supervise.observation import Observers
from orchestra.supervise.recorder import Recorder


class Listener(Protocol):
    """The system, as its processes see it: it hears what concerns more than one of them."""

    def changed(self) -> None:
        """A process is in another phase."""

    def ended(self, process: str) -> None:
        """One run of a process is over."""

    def failed(self, reason: str, about: str | None = None) -> None:
        """The run cannot go on; `about` names the process whose last lines belong to the message."""

    def look(self) -> None:
        """Find out who became our child."""


@dataclass(frozen=True, slots=True)
class Surroundings:
    """The loop, who is whose child, where output and events go, and what looks into the ROS graph."""

    loop: Loop
    kin: Kin
    journal: Journal
    recorder: Recorder
    observers: Observers
    environment: Callable[[Process], dict[str, str]]
