"""What the parts of a running system share."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from orchestra.dataclass import dataclass
from orchestra.logs.journal import Journal
from orchestra.plan.model import Process
from orchestra.supervise.graph.observation import Observers
from orchestra.supervise.keeping.kin import Kin
from orchestra.supervise.limits.confines import Confines
from orchestra.supervise.loop import Loop
from orchestra.supervise.options import RunOptions
from orchestra.supervise.output.console import Console
from orchestra.supervise.output.intake import Intake
from orchestra.supervise.output.recorder import Recorder
from orchestra.supervise.reactions.questions import Questions
from orchestra.supervise.service_manager import ServiceManager
from orchestra.supervise.signs.trial import Trials
from orchestra.supervise.warm.starts import Starts

if TYPE_CHECKING:
    from orchestra.supervise.process.ending import Ending


class Listener(Protocol):
    """The system, as its processes see it: it hears what concerns more than one of them."""

    def changed(self, process: str | None = None) -> None:
        """A process is in another phase; None: something else has happened that may concern any of them."""

    def again(self) -> None:
        """Something is left for the next round."""

    def started(self, process: str, pid: int) -> None:
        """The program of a process runs."""

    def ended(self, process: str, pid: int | None, ending: Ending, *, intended: bool) -> None:
        """One run of a process is over, or has not come about; `intended` by an operator."""

    def completed(self, process: str, ending: Ending, *, intended: bool) -> None:
        """The last run of a process is over: it will not start again by itself; `intended` by an operator."""

    def skipped(self, process: str) -> None:
        """A process will never begin."""

    def wrote(self, process: str, pid: int, stream: str, data: bytes) -> None:
        """A program has written something."""

    def failed(self, reason: str, about: str | None = None) -> None:
        """The run cannot go on; `about` names the process whose last lines belong to the message."""

    def went_wrong(self, what: str) -> None:
        """Something that the plan says could not be done; the run goes on."""

    def look(self) -> None:
        """Find out who became our child."""

    def quiesce(self, process: str, done: Callable[[], None]) -> None:
        """Let the nodes of a process leave their work before it is ended; `done` is called once it is over."""


@dataclass(frozen=True, slots=True)
class Surroundings:
    """The loop, our children, where output and events go, what looks into the ROS graph, and who knows the user's code.

    `environment` is that of a process; of None what every process has before its description adds to it. `folder` is
    the run directory. `intake` says how fast output may be read, `console` is the user's terminal. `more_time` asks the
    keeper to wait so many seconds for the end of the run, which is longer than usual, and tells whether it will.
    """

    loop: Loop
    kin: Kin
    journal: Journal
    recorder: Recorder
    intake: Intake
    console: Console
    observers: Observers
    trials: Trials
    service: ServiceManager
    questions: Questions
    starts: Starts
    confines: Confines
    environment: Callable[[Process | None], dict[str, str]]
    folder: Path
    options: RunOptions
    more_time: Callable[[float], bool]
