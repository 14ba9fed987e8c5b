"""Which run a command is about, and talking with it."""

from __future__ import annotations

import sys
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from orchestra.control.client import Client, GoneError
from orchestra.control.protocol import Refusal
from orchestra.errors import RunError, UsageError
from orchestra.nearest import nearest
from orchestra.supervise.runs import registry
from orchestra.supervise.runs.directory import state_folder

if TYPE_CHECKING:
    from argparse import ArgumentParser
    from collections.abc import Iterator

    from orchestra.supervise.runs.registry import Run

# Faults of the command line, where everything else is a matter of the run.
_OF_THE_USER = frozenset({"unknown_process", "unknown_signal", "malformed"})


def add_to(parser: ArgumentParser, which: str = "of several that are alive") -> None:
    """Let a parser read which run is meant."""
    parser.add_argument("--run", metavar="RUN", help=f"the name of the run, {which}")


def folder() -> Path:
    """Return where the run directories are."""
    return state_folder() / "runs"


def living(name: str | None) -> Run:
    """Return the living run of a name, the only one where none is given.

    Raises `RunError` where none is alive, `UsageError` where the name is that of none, or several are alive.
    """
    runs = registry.living(folder())
    if not runs and name is None:
        raise RunError("no run is alive; 'orchestra launch' starts one")
    found = [run for run in runs if name in (None, run.name, run.directory.name, str(run.directory))]
    if not found:
        near = nearest(name or "", [run.name for run in runs])
        hint = f"; did you mean '{near}'?" if near else f"; alive: {_listed(runs)}" if runs else ""
        raise UsageError(f"no run '{name}' is alive{hint}")
    if len(found) > 1:
        raise UsageError(f"several runs are alive; say which with --run: {_listed(found)}")
    return found[0]


def recorded(name: str | None) -> Path:
    """Return the directory of a run that is alive or over: of this name or path, else the only living, else the latest.

    Raises `RunError` where there was none, `UsageError` where none has the name, or several are alive.
    """
    runs = registry.living(folder())
    if name is None and len(runs) > 1:
        raise UsageError(f"several runs are alive; say which with --run: {_listed(runs)}")
    if name is None and runs:
        return runs[0].directory
    folders = registry.folders(folder())
    if name is None:
        if not folders:
            raise RunError(f"there has been no run yet in {folder()}")
        return folders[-1]
    alive = [run.directory for run in runs if run.name == name]
    named = [path for path in folders if name in (path.name, registry.name_of(path))]
    found = [*named, *alive]
    if found:
        return found[-1]
    if "/" in name and (Path(name) / "events.jsonl").is_file():
        return Path(name)
    near = nearest(name, {registry.name_of(path) for path in folders})
    raise UsageError(f"there is no run '{name}'" + (f"; did you mean '{near}'?" if near else ""))


@contextmanager
def connected(run: Run) -> Iterator[Client]:
    """Talk with a run. Raises `RunError` where it does not, `UsageError` where it refuses what the user has written."""
    try:
        with Client(run.directory) as client:
            yield client
    except GoneError as error:
        raise RunError(f"{run.name}: {error}") from error
    except Refusal as refusal:
        if refusal.code in _OF_THE_USER:
            raise UsageError(str(refusal)) from refusal
        raise RunError(f"{run.name}: {refusal}") from refusal


def told(text: str) -> None:
    """Say something that is not the product of the command."""
    sys.stderr.write(f"{text}\n")


def as_json(document: Any) -> str:  # noqa: ANN401 - JSON
    """Return a document as the text that a command prints."""
    import json  # noqa: PLC0415 - most of the time the user wants a table

    return json.dumps(document, indent=2, ensure_ascii=False) + "\n"


def _listed(runs: list[Run]) -> str:
    return ", ".join(run.name for run in runs)
