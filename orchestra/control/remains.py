"""What runs that died have left besides processes: their sockets, their begun directories, memory and its caps.

Both keeper and supervisor of such a run are dead; while one of them lives, everything below it is its business. The
processes are the matter of `supervise.keeping.remnants`.
"""

from __future__ import annotations

import contextlib
import os
from typing import TYPE_CHECKING

from orchestra.control import door
from orchestra.control.place import ENDING, folders
from orchestra.supervise.keeping import proc, shared_memory
from orchestra.supervise.limits import caps
from orchestra.supervise.runs import identity
from orchestra.supervise.runs.directory import bring_home

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from orchestra.supervise.runs.registry import Run


def tidy(run: Run) -> None:
    """Remove the socket and the memory caps of a dead run, and let its directory be that of a run that has ended.

    What code of its launch files has written elsewhere becomes part of that. Shared memory that nobody uses any more
    goes. Raises `OSError`.
    """
    caps.clear_run(run.identity.run)
    shared_memory.remove_leftovers(run.identity.began)
    path = door.linked(run.directory)
    if path is not None and path.endswith(f"/{run.identity.run}{ENDING}"):
        door.remove(path)
    with contextlib.suppress(FileNotFoundError):  # another command does the same
        bring_home(run.directory)
    with contextlib.suppress(FileNotFoundError):  # as above
        identity.settle(run.directory)


def stale_sockets() -> Iterator[str]:
    """Yield the sockets of this user at which nobody listens, whichever state folder their runs had."""
    for folder in folders():
        try:
            names = os.listdir(folder)  # noqa: PTH208 - names are wanted, not paths
        except OSError:
            continue
        yield from (path for name in names if door.is_stale(path := f"{folder}/{name}"))


def begun(runs: Path, beginning: str) -> Iterator[Path]:
    """Yield the files of detached runs that were killed before they had a directory; their names end with a pid."""
    for path in runs.glob(f"{beginning}*"):
        number = path.name.removeprefix(beginning)
        if number.isdecimal() and proc.birth(int(number)) is None:
            yield path
