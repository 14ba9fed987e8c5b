"""The directory of a run: `$ORCHESTRA_HOME/runs/TIME-NAME/` with plan, events, parameter files and logs."""

from __future__ import annotations

import fcntl
import itertools
import os
import time
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.fields import replace
from orchestra.patterns import pattern
from orchestra.supervise.runs import identity
from orchestra.supervise.runs.registry import folders, living
from orchestra.supervise.runs.running import LOCK, RUNNING, is_locked, state_path

if TYPE_CHECKING:
    from collections.abc import Container, Iterator

    from orchestra.supervise.runs.identity import Identity

# Old runs that are kept, the current one included.
KEPT_RUNS = 20
_UNFIT = pattern(r"[^A-Za-z0-9_.-]+")
# How long a run waits for another that is choosing its name, in seconds.
_NAMING_PATIENCE, _NAMING_PAUSE = 2.0, 0.01


class NameTakenError(Exception):
    """A living run, in `directory`, has the name already."""

    def __init__(self, name: str, directory: Path) -> None:
        super().__init__(f"a run named '{name}' is alive: {directory}")
        self.directory = directory


class RunDirectory:
    """A directory of which a running supervisor holds the lock."""

    def __init__(self, path: Path, lock: int, known: Identity) -> None:
        self.path = path
        self.identity = known
        self._lock = lock

    @property
    def name(self) -> str:
        """The name of the run among the living."""
        return self.identity.name

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

    def release(self, *, settled: bool = True) -> None:
        """Let the directory become an old run, with all that belongs to it. Raises `OSError` where that cannot be had.

        Without this the kernel unlocks it when the process ends. A run that is not `settled` left processes: it stays
        one that somebody has to look after.
        """
        try:
            if settled:
                identity.settle(self.path)
            bring_home(self.path)
        finally:
            os.close(self._lock)


def state_folder() -> Path:
    """Return `$ORCHESTRA_HOME`, else `orchestra` in the user's state folder (XDG base directory specification)."""
    return Path(state_path())


def create(runs: Path, wanted: Identity, *, exact: bool = False) -> RunDirectory:
    """Create and lock the directory of a new run, whose name becomes one that no living run has.

    Raises `NameTakenError` where the name must stay as it is (`exact`), `OSError` where no directory can be had.
    """
    runs.mkdir(parents=True, exist_ok=True)
    with _alone(runs):
        others = {run.name: run.directory for run in living(runs)}
        if exact and wanted.name in others:
            raise NameTakenError(wanted.name, others[wanted.name])
        named = replace(wanted, name=_free(wanted.name, others))
        path = _new_folder(runs, _stem(named.name))
        lock = _locked(path)
        identity.write(path, named)
    for part in ("params", "logs"):
        (path / part).mkdir()
    return RunDirectory(path, lock, named)


def bring_home(path: Path) -> None:
    """Move files from elsewhere, where there are some, to the run directory that has adopted them. Raises `OSError`."""
    files = path / "files"
    if files.is_symlink():
        import shutil  # noqa: PLC0415 - few runs have files of launch files' code

        folder = files.readlink()
        files.unlink()
        shutil.move(folder, files)


def prune(runs: Path, keep: int = KEPT_RUNS) -> None:
    """Remove the oldest runs beyond `keep`; never one that is running or died, nor anything that is not a run."""
    for path in folders(runs)[:-keep]:
        if not (path / RUNNING).exists() and not is_locked(path / LOCK):
            import shutil  # noqa: PLC0415 - slow, and it is the end of the run

            shutil.rmtree(path, ignore_errors=True)


def _stem(name: str) -> str:
    return f"{time.strftime('%Y%m%d-%H%M%S')}-{_UNFIT.sub('-', name).strip('.-') or 'run'}"[:200]


def _free(name: str, taken: Container[str]) -> str:
    """Return the name, or with the first number behind it that makes it one of its own."""
    candidates = itertools.chain([name], (f"{name}-{number}" for number in itertools.count(2)))
    return next(candidate for candidate in candidates if candidate not in taken)


@contextmanager
def _alone(runs: Path) -> Iterator[None]:
    """Keep others from choosing a name meanwhile.

    Whoever holds the lock needs it for a moment; where it is stopped meanwhile, nobody waits for it for long.
    """
    lock = os.open(runs, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
    try:
        deadline = time.monotonic() + _NAMING_PATIENCE
        while not _taken(lock) and time.monotonic() < deadline:
            time.sleep(_NAMING_PAUSE)
        yield
    finally:
        os.close(lock)


def _taken(lock: int) -> bool:
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:  # a file system that locks no folders: two runs of one second may get one name
        return True
    return True


def _locked(path: Path) -> int:
    """Lock a run directory. Nobody ever sees the lock without its holder, who then would be taken for dead."""
    lock = os.open(path / f".{LOCK}", os.O_CREAT | os.O_RDWR | os.O_CLOEXEC, 0o600)
    fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    (path / f".{LOCK}").rename(path / LOCK)
    return lock


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
