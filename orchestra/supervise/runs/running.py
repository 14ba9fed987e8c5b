"""Which run directories are of runs that have not ended in order: a look that costs a start next to nothing.

A run directory has `running.json` from its begin on; at the end of the run it becomes `run.json`. What has the first
and a lock that nobody holds is of a run that lives no more, or is just being ended by its keeper. This module is
imported in the process that becomes the keeper, so it uses neither pathlib nor json.
"""

from __future__ import annotations

import fcntl
import os

RUNNING, ENDED, LOCK = "running.json", "run.json", "lock"


def state_path() -> str:
    """Return `$ORCHESTRA_HOME`, else `orchestra` in the user's state folder (XDG base directory specification)."""
    home = os.environ.get("ORCHESTRA_HOME")
    if home:
        return os.path.abspath(home)  # noqa: PTH100 - pathlib is slow to import and this runs in the keeper
    state = os.environ.get("XDG_STATE_HOME") or os.path.expanduser("~/.local/state")  # noqa: PTH111 - as above
    return os.path.join(os.path.abspath(state), "orchestra")  # noqa: PTH100, PTH118 - as above


def unfinished(runs: str) -> list[str]:
    """Return the names of the directories of runs that have not ended in order, oldest first."""
    try:
        names = os.listdir(runs)  # noqa: PTH208 - as above
    except OSError:
        return []
    return sorted(name for name in names if os.access(f"{runs}/{name}/{RUNNING}", os.F_OK))


def abandoned(runs: str) -> list[str]:
    """Return those of them whose supervisor lives no more."""
    return [name for name in unfinished(runs) if not is_locked(f"{runs}/{name}/{LOCK}")]


def is_locked(path: str | os.PathLike[str]) -> bool:
    """Tell whether a supervisor holds a lock; one that cannot be read counts as held. Two who ask see no difference."""
    try:
        lock = os.open(path, os.O_RDONLY | os.O_CLOEXEC)
    except OSError:
        return True
    try:
        fcntl.flock(lock, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except OSError:
        return True
    finally:
        os.close(lock)
    return False
