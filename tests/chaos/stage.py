"""Where a chaos run takes place: folders of its own, and namespaces of its own where the kernel lets us have them.

With a mount namespace the run has a /dev/shm and a small disk that nobody else writes to; with a network namespace its
abstract sockets are those that are there (unix(7)). A holder keeps both until we have looked. Processes are found by
namespace, and by descent: whoever plays is a subreaper, so nothing that the run loses gets past it, whatever it did to
its environment, its session and its parents.
"""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import time
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.supervise.keeping import proc
from orchestra.supervise.limits import cgroups
from tests.chaos.inventing import Abilities

if TYPE_CHECKING:
    from collections.abc import Iterator

# One file for all programs of a user that can be traced, nodes among them; lttng-ust(3) leaves it to the next one.
_OF_THE_USER = "lttng-ust-wait-"
# The folder for the sockets of all runs of a user.
_SOCKETS = "runtime/orchestra"
_AS_ROOT = ("--mount", "--net", "--propagation", "private")
_AS_USER = ("--user", "--map-root-user", *_AS_ROOT)
_FURNISH = (
    "mount -t tmpfs shm /dev/shm && "
    'if [ -n "$2" ]; then mount -t tmpfs -o size="$2"k,nr_inodes=4k disk "$1"; fi && '
    "{ ip link set lo up || true; } && echo there && exec cat"
)


@cache
def unshare_words() -> tuple[str, ...] | None:
    """Return how to get namespaces of our own here; None where that is not allowed."""
    for words in (_AS_ROOT, _AS_USER):
        command = ["unshare", *words, "mount", "-t", "tmpfs", "trial", "/dev/shm"]  # noqa: S108 - of its own
        with contextlib.suppress(OSError):
            if subprocess.run(command, capture_output=True, check=False, timeout=60).returncode == 0:
                return words
    return None


@cache
def here() -> Abilities:
    """Return what is possible on this machine."""
    place = cgroups.find_place(cgroups.own_hierarchy(), [os.getpid()])
    return Abilities(unshare_words() is not None, isinstance(place, cgroups.Place) and not place.vacate)


@dataclass(frozen=True)
class Stage:
    """The folders of a run. `holder` is the process that keeps the namespaces, None where there are none."""

    folder: Path
    holder: int | None

    @property
    def home(self) -> Path:
        """ORCHESTRA_HOME, as the run calls it."""
        return self.folder / "home"

    def seen(self, path: Path) -> Path:
        """Return where a path of the run is to be found from outside."""
        return path if self.holder is None else Path(f"/proc/{self.holder}/root{path}")

    @property
    def through(self) -> tuple[str, ...]:
        """The words that take a command onto the stage."""
        if self.holder is None:
            return ()
        user = () if unshare_words() == _AS_ROOT else ("--user", "--preserve-credentials")
        where = f"--wd={self.folder / 'work'}"
        return ("nsenter", f"--target={self.holder}", *user, "--mount", "--net", where, "--")

    @property
    def environment(self) -> dict[str, str]:
        """The environment in which the run begins."""
        ours = {
            "ORCHESTRA_HOME": str(self.home),
            "HOME": str(self.folder / "user"),
            "TMPDIR": str(self.folder / "tmp"),
            "XDG_RUNTIME_DIR": str(self.folder / "runtime"),
        }
        return {**os.environ, **ours}

    def sockets(self) -> list[str]:
        """Return the names of the sockets that are there: abstract ones, and those that are files."""
        found = [str(path) for path in self.socket_files()]
        if self.holder is not None:
            lines = Path(f"/proc/{self.holder}/net/unix").read_text().splitlines()[1:]
            found += [line.split(maxsplit=7)[7] for line in lines if len(line.split(maxsplit=7)) > 7]
        return found

    def socket_files(self) -> list[Path]:
        """Return the sockets that are files."""
        folders = [self.folder / name for name in ("tmp", "runtime", "work", "user")]
        found = [path for folder in (*folders, self.seen(self.home)) for path in folder.rglob("*")]
        return [path for path in found if path.is_socket()]

    def litter(self) -> list[str]:
        """Return the files that a run may not leave: temporary ones, and shared memory."""
        found = [
            str(path) for path in self._files("tmp", "runtime", "work") if path != self.folder / _SOCKETS
        ]
        if self.holder is not None:
            shared = self.seen(Path("/dev/shm")).iterdir()  # noqa: S108 - of its own
            found += [str(path) for path in shared if not path.name.startswith(_OF_THE_USER)]
        return found

    def groups(self, keeper: int) -> list[str]:
        """Return the control groups that were made for the run of a keeper."""
        hierarchy = cgroups.own_hierarchy()
        folders = cgroups.upwards(hierarchy) if hierarchy else []
        return [str(path) for folder in folders for path in Path(folder).glob(f"orchestra-*-{keeper}.*")]

    def processes(self) -> dict[int, str]:
        """Return what runs below us, apart from the holder."""
        found = {*proc.descendants(os.getpid()), *self._inhabitants()} - {self.holder}
        return {pid: proc.command(pid) for pid in found if pid is not None}

    def _inhabitants(self) -> list[int]:
        ours = None if self.holder is None else _namespace(self.holder)
        return [pid for pid in proc.pids() if _namespace(pid) == ours] if ours else []

    def clear(self) -> None:
        """Kill what runs below us until nothing does."""
        while left := self.processes():
            for pid in left:
                with contextlib.suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)
            time.sleep(0.01)

    def _files(self, *names: str) -> list[Path]:
        return [path for name in names for path in (self.folder / name).rglob("*")]


def _namespace(pid: int) -> str | None:
    try:
        return str(Path(f"/proc/{pid}/ns/mnt").readlink())
    except OSError:
        return None


@contextmanager
def staged(folder: Path, disk: int | None) -> Iterator[Stage]:
    """Furnish a folder; `disk` is the size in KiB of what the run's own files may take."""
    for name in ("home", "user", "tmp", "runtime", "work"):
        (folder / name).mkdir(parents=True)
    (folder / "runtime").chmod(0o700)
    words = unshare_words()
    if words is None:
        yield Stage(folder, None)
        return
    size = "" if disk is None else str(disk)
    command = ["unshare", *words, "sh", "-c", _FURNISH, "sh", str(folder / "home"), size]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as holder:
        assert holder.stdout is not None
        assert holder.stdout.readline() == b"there\n", "the stage could not be furnished"
        yield Stage(folder, holder.pid)
        assert holder.stdin is not None
        holder.stdin.close()
