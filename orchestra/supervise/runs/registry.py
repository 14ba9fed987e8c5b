"""The runs of a state folder: which are alive, and which died without an end."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.patterns import pattern
from orchestra.supervise.runs import identity
from orchestra.supervise.runs.identity import Identity
from orchestra.supervise.runs.running import LOCK, abandoned, is_locked, unfinished

if TYPE_CHECKING:
    from collections.abc import Iterable

_OURS = pattern(r"\d{8}-\d{6}-(.+)")


@dataclass(frozen=True, slots=True)
class Run:
    """A run and its directory."""

    directory: Path
    identity: Identity

    @property
    def name(self) -> str:
        """The name that it has among the living."""
        return self.identity.name


def living(runs: Path) -> list[Run]:
    """Return the runs that have a supervisor, oldest first."""
    names = (name for name in unfinished(str(runs)) if is_locked(runs / name / LOCK))
    return _identified(runs / name for name in names)


def dead(runs: Path) -> list[Run]:
    """Return the runs that have neither supervisor nor keeper any more and did not end in order, oldest first."""
    found = _identified(runs / name for name in abandoned(str(runs)))
    return [run for run in found if not identity.keeper_lives(run.identity)]


def folders(runs: Path) -> list[Path]:
    """Return all run directories, oldest first; nothing else that may be there."""
    try:
        return sorted(entry for entry in runs.iterdir() if _OURS.fullmatch(entry.name) and entry.is_dir())
    except FileNotFoundError:
        return []


def name_of(directory: Path) -> str:
    """Return the name that the run of a directory has, or had."""
    known = identity.read(directory)
    if known:
        return known.name
    matched = _OURS.fullmatch(directory.name)
    return matched.group(1) if matched else directory.name


def _identified(directories: Iterable[Path]) -> list[Run]:
    """Leave out what went meanwhile, and what is not of this version."""
    found = ((directory, identity.read(directory)) for directory in directories)
    return [Run(directory, known) for directory, known in found if known]
