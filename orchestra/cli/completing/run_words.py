"""Words of the commands that name runs and processes of runs."""

from __future__ import annotations

import signal
from typing import TYPE_CHECKING

from orchestra import events
from orchestra.cli.completing.candidates import Candidate
from orchestra.logs.names import shown
from orchestra.supervise.runs import registry
from orchestra.supervise.runs.directory import state_folder

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from pathlib import Path


def run_names() -> Iterator[Candidate]:
    """Yield the runs that are alive, then the others that are recorded."""
    runs = state_folder() / "runs"
    for run in registry.living(runs):
        yield Candidate(run.name, f"alive: {run.identity.file}")
    for folder in reversed(registry.folders(runs)):
        yield Candidate(registry.name_of(folder), folder.name)


def process_words(before: Sequence[str], begun: str) -> Iterator[Candidate]:
    """Yield the processes of the runs that are alive, and their namespaces; of the latest where none is."""
    del begun
    runs = state_folder() / "runs"
    directories = [run.directory for run in registry.living(runs)] or registry.folders(runs)[-1:]
    names = {name: None for directory in directories for name in map(shown, _processes(directory))}
    for name in names:
        if name not in before:
            yield Candidate(name)
    for folder in dict.fromkeys(f"{name.rpartition('/')[0]}/" for name in names if "/" in name):
        yield Candidate(folder, "everything in this namespace")


def signal_words(before: Sequence[str], begun: str) -> Iterable[Candidate]:
    """Yield a signal, and then what gets it."""
    if before:
        return process_words(before[1:], begun)
    return [Candidate(number.name) for number in signal.Signals]


def _processes(directory: Path) -> Iterator[str]:
    """Yield what has waited to begin in a run: every process does."""
    try:
        with (directory / "events.jsonl").open("rb") as lines:
            for line in lines:
                if b'"process_waiting"' in line and (process := events.loads(line).process):
                    yield process
    except (OSError, ValueError):
        return  # nothing is known of it, or not all of it yet
