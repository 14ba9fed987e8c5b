"""What a run writes: the output of its processes, its events, and what it says itself."""

from __future__ import annotations

import os
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.logs import forms
from orchestra.logs.journal import Journal
from orchestra.logs.outputs import OVERRIDE, forced_output
from orchestra.logs.rotation import ENDLESS, Rotation
from orchestra.logs.writer import STUCK_AFTER, Writer
from orchestra.supervise.outcome import FAILED
from orchestra.supervise.output.intake import Intake
from orchestra.supervise.output.recorder import Recorder
from orchestra.supervise.resolver.resolving import Refused

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from orchestra.logs.sheets import Sheets
    from orchestra.plan.model import Plan
    from orchestra.supervise.loop import Loop
    from orchestra.supervise.options import RunOptions
    from orchestra.supervise.runs.directory import RunDirectory


@dataclass(frozen=True, slots=True)
class Books:
    """Events, output, and how fast the latter may be read."""

    recorder: Recorder
    journal: Journal
    intake: Intake


@contextmanager
def books(
    loop: Loop, directory: RunDirectory, plan: Plan, options: RunOptions, sheets: Sheets
) -> Iterator[Books]:
    """Open what a run writes to; at the end it is all on the disk, unless that hangs."""
    with ExitStack() as opened:
        warn = _Warning()
        writer = _writer(warn)
        opened.callback(writer.close)
        recorder = Recorder(writer.file(directory.events, ENDLESS, forms.EVENTS))
        opened.callback(recorder.close)
        forced, complaint = _forced(options)
        journal = Journal(
            directory.logs,
            {process.id: process.output for process in plan.processes},
            sheets,
            writer,
            lambda text: recorder.record("message", text=text),
            rotation=Rotation(options.log_size, options.log_keep),
            forced=forced,
        )
        warn.say = journal.say
        if complaint:
            journal.say(complaint)
        opened.callback(journal.settle)
        opened.callback(journal.close)
        intake = Intake(loop, writer, warn.stuck)
        opened.callback(intake.close)
        yield Books(recorder, journal, intake)


def _writer(warn: _Warning) -> Writer:
    try:
        return Writer(warn)
    except RuntimeError as error:  # where there is no room for one more thread
        raise Refused(FAILED, f"the run cannot begin: {error}") from error


def _forced(options: RunOptions) -> tuple[str | None, str | None]:
    """Return the output that counts for every process, and what is wrong with the caller's wish for one."""
    if options.detached:
        return "own_log", None
    try:
        return forced_output(os.environ, show_all=options.show_all_output), None
    except ValueError as error:
        return None, f"{OVERRIDE} is ignored: {error}"


class _Warning:
    """Tells about files that cannot be written: once for all of them, since the cause is one."""

    def __init__(self) -> None:
        self.say: Callable[[str], None] | None = None

    def __call__(self, path: Path, error: OSError) -> None:
        self._tell(f"{path} cannot be written: {error.strerror}")

    def stuck(self) -> None:
        """Tell that the disk does not answer."""
        self._tell(
            f"the disk has taken nothing for {STUCK_AFTER:g} s; until it does, what does not fit is dropped"
        )

    def _tell(self, why: str) -> None:
        say, self.say = self.say, None
        if say:
            say(f"logs are incomplete: {why}")
