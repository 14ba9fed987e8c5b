"""Which run a run directory is of: its name, its mark and its processes, kept in the directory."""

from __future__ import annotations

import json
import os
import time
from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.fields import fields
from orchestra.supervise.keeping import proc
from orchestra.supervise.runs.running import ENDED, RUNNING

if TYPE_CHECKING:
    from pathlib import Path


@dataclass(frozen=True, slots=True)
class Identity:
    """A run. `run` is the mark that its processes carry, `name` is its own among the runs that are alive.

    `keeper` and `supervisor` are pids; `keeper_birth` is what `orchestra.supervise.keeping.proc.birth` says of the
    keeper. `file` is the launch file, `began` in seconds since the epoch.
    """

    run: str
    name: str
    file: str
    keeper: int
    keeper_birth: int | None
    supervisor: int
    began: float


def identity(run: str, name: str, file: str, keeper: int) -> Identity:
    """Return the identity of the run that this process, the supervisor, is about to begin."""
    return Identity(run, name, file, keeper, proc.birth(keeper), os.getpid(), time.time())


def write(directory: Path, content: Identity) -> None:
    """Keep an identity in the directory of a run that begins. Raises `OSError`."""
    path = directory / RUNNING
    made = directory / f".{RUNNING}"
    made.write_text(
        json.dumps({item.name: getattr(content, item.name) for item in fields(content)}, indent=2) + "\n",
        "utf-8",
        "surrogateescape",
    )
    made.rename(path)


def read(directory: Path) -> Identity | None:
    """Return the identity that a run directory has, None where it has none that can be read."""
    for name in (RUNNING, ENDED):
        try:
            document = json.loads((directory / name).read_text("utf-8", "surrogateescape"))
            return Identity(**document)
        except (OSError, ValueError, TypeError):
            continue
    return None


def settle(directory: Path) -> None:
    """Let the directory be of a run that has ended. Raises `OSError`."""
    (directory / RUNNING).rename(directory / ENDED)


def keeper_lives(content: Identity) -> bool:
    """Tell whether the keeper is there, and not another process that was given its pid."""
    return content.keeper_birth is not None and proc.birth(content.keeper) == content.keeper_birth
