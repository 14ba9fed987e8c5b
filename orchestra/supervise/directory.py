"""The directory of a run: `$ORCHESTRA_HOME/runs/TIME-NAME/` with plan, events, parameter files and logs."""

from __future__ import annotations

import fcntl
import os
import re
import shutil
import time
from pathlib import Path

# Old runs that are kept, the current one included.
KEPT_RUNS = 20
_OURS = re.compile(r"\d{8}-\d{6}-.+")
_UNFIT = re.compile(r"[^A-Za-z0-9_.-]+")


class RunDirectory:
    """A directory of which a running supervisor holds the lock."""

    def __init__(self, path: Path, lock: int) -> None:
        self.path = path
        self._lock = lock

    @property
    def logs(self) -> Path:
        """Where the output of processes goes."""
        return self.path / "logs"

    @property
    def events(self) -> Path:
        """The event stream."""
        return self.path / "events.jsonl"

    def adopt(self, folder: str) -> None:
        """Let a folder from elsewhere be the part `files`; it stays where it is while somebody may write to it."""
        (self.path / "files").symlink_to(folder)

    def release(self) -> None:
        """Let the directory become an old run, with all that belongs to it. Raises `OSError` where that cannot be had.

        Without this the kernel unlocks it when the process ends.
        """
        files = self.path / "files"
        try:
            if files.is_symlink():
                folder = files.readlink()
                files.unlink()
                shutil.move(folder, files)
        finally:
            os.close(self._lock)


def state_folder() -> Path:
    """Return `$ORCHESTRA_HOME`, else `orchestra` in the user's state folder (XDG base directory specification)."""
    home = os.environ.get("ORCHESTRA_HOME")
    if home:
        return Path(home).absolute()
    state = os.environ.get("XDG_STATE_HOME")
    return (Path(state).absolute() if state else Path.home() / ".local" / "state") / "orchestra"


def create(runs: Path, name: str) -> RunDirectory:
    """Create and lock the directory of a new run. Raises `OSError` where that is impossible."""
    stem = f"{time.strftime('%Y%m%d-%H%M%S')}-{_UNFIT.sub('-', name).strip('.-') or 'run'}"[:200]
    runs.mkdir(parents=True, exist_ok=True)
    path = _new_folder(runs, stem)
    for part in ("params", "logs"):
        (path / part).mkdir()
    lock = os.open(path / "lock", os.O_CREAT | os.O_RDWR | os.O_CLOEXEC, 0o600)
    fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    return RunDirectory(path, lock)


def prune(runs: Path, keep: int = KEPT_RUNS) -> None:
    """Remove the oldest runs beyond `keep`; never one that is running, nor anything that is not a run."""
    old = sorted(entry for entry in runs.iterdir() if _OURS.fullmatch(entry.name) and entry.is_dir())
    for path in old[:-keep]:
        if not _is_running(path):
            shutil.rmtree(path, ignore_errors=True)


def _new_folder(runs: Path, stem: str) -> Path:
    attempt = 1
    while True:
        path = runs / (stem if attempt == 1 else f"{stem}-{attempt}")
        try:
            path.mkdir()
        except FileExistsError:
            attempt += 1
        else:
            return path


def _is_running(path: Path) -> bool:
    """Tell whether a supervisor holds the lock; a run without one is being set up, or is a stranger's."""
    try:
        lock = os.open(path / "lock", os.O_RDWR | os.O_CLOEXEC)
    except OSError:
        return True
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return True
    finally:
        os.close(lock)
    return False
