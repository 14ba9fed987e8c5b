"""`orchestra clean`: end what runs that died have left, and remove what is of no use any more."""

from __future__ import annotations

import contextlib
import sys
from typing import TYPE_CHECKING

from orchestra.cli import remains as telling
from orchestra.cli import runs
from orchestra.cli.detaching import BEGINNING
from orchestra.cli.parser import CommandParser
from orchestra.control import door, remains
from orchestra.supervise.runs import registry

if TYPE_CHECKING:
    from argparse import Namespace

_EPILOG = "A run that is alive, and everything that belongs to it, is left alone."
LEFT, UNSTOPPABLE = 1, 4


def parser() -> CommandParser:
    """Return what the command understands."""
    made = CommandParser("clean", "End what runs that died have left, and remove their sockets.", _EPILOG)
    made.add_argument("-y", "--yes", action="store_true", help="do not ask")
    return made


def run(options: Namespace) -> int:
    """Clean up: 0 where nothing is left, 1 where the user has not agreed to it, 4 where something cannot be ended."""
    status = 0
    ended = 0
    for one, remnants in telling.left_of(registry.dead(runs.folder())):
        if not remnants:
            remains.tidy(one)
            continue
        what = telling.described(one, remnants)
        if not options.yes and not telling.asked(f"{what}. End them?"):
            runs.told(f"{what}; 'orchestra clean --yes' ends them")
            status = max(status, LEFT)
            continue
        stuck = telling.end(one)
        ended += len(remnants) - len(stuck)
        status = UNSTOPPABLE if stuck else status
    removed = _remove_files()
    sys.stdout.write(f"{_count(ended, 'process', 'es')} ended, {_count(removed, 'file')} removed\n")
    return status


def _remove_files() -> int:
    """Remove sockets at which nobody listens, and files of runs that never came to be; return how many."""
    removed = 0
    for path in remains.stale_sockets():
        door.remove(path)
        removed += 1
    for file in remains.begun(runs.folder(), BEGINNING):
        with contextlib.suppress(FileNotFoundError):
            file.unlink()
            removed += 1
    return removed


def _count(number: int, noun: str, plural: str = "s") -> str:
    return f"{number} {noun}{'' if number == 1 else plural}"
