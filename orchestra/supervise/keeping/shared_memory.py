"""Removes shared memory that participants of Fast DDS, ended by SIGKILL or a crash, could not remove themselves.

Seen with Fast DDS 2.14 in /dev/shm: a participant has a segment `fastrtps_HEX` and a port `fastrtps_portN` with its
mutex `sem.fastrtps_portN_mutex`, and holds a lock (flock(2)) on the file `..._el` of each as long as it lives. It maps
its own segments and ports, and those of all whom it talks to. One that ends by itself removes everything.

They are removed where they are ours, came while the run did, nobody holds their lock, and nobody whom we can see maps
them: locks also tell of processes in other namespaces. Where there is no lock, they must have been there for a while,
for whoever makes them maps them a moment later. The lock is held meanwhile, so that nobody can begin to use them.

The port of a dead reader is closed at once, whoever else maps it: its lock is held, and its name is a folder, which can
neither be opened nor made. Who sends to a port that is no longer in order, and finds its lock free, clears up behind
the reader in a way in which it waits for itself, for ever, if that one died while it took a message (Fast DDS up to
2.14.6 and 3.6.2, its issue 6485). Where nothing is left, each sender makes the port anew for each message and removes
it again, until it forgets the reader; whoever begins to read there meanwhile may have its own port removed, and hears
nothing (one of 50 nodes that were started again). So the next reader takes another port, as where a living one has it.
"""

from __future__ import annotations

import fcntl
import math
import os
import time
from contextlib import contextmanager, suppress

from orchestra.patterns import pattern

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

_FOLDER = "/dev/shm"  # noqa: S108 - where Linux has POSIX shared memory (shm_overview(7))
# What is removed together has one stem.
_STEM = r"fastrtps_(?:[0-9a-f]{16}|port[0-9]+)"
_OURS = pattern(rf"(?:sem\.)?({_STEM})(?:_mutex|_el|_sl)?")
_LOCKS = ("_el", "_sl")
# The lock of the one reader of a port.
_READER = pattern(r"(fastrtps_port[0-9]+)_el")
# A lock that is younger, in seconds, may be about to be taken; nobody knows its port yet.
_FRESH = 0.1
# For how long a sender may not have forgotten a reader that has died, in seconds: Fast DDS gives a participant 20 s to
# tell that it lives.
_FORGOTTEN = 30.0
# How long a file without a lock must have been there, in seconds.
_SETTLED = 2.0
# Time stamps of files are those of the latest tick of the kernel's clock, and may lie a little before the run.
_TICK = 0.1


def remove_leftovers(began: float) -> list[str]:
    """Remove what nobody uses of that which came since `began`, in seconds since the epoch; return the names."""
    stems = [stem for stem in _stems(began) if _is_free(stem)]
    if not stems:
        return []
    mapped = _mapped()
    return [file for stem in stems if stem not in mapped for file in _remove(stem)]


class DeadReaders:
    """The ports whose one reader has died, closed for as long as others still send there."""

    def __init__(self) -> None:
        # By the stem of a port: the descriptor of its lock, and since when it is held, in seconds that only pass.
        self._held: dict[str, tuple[int, float]] = {}
        # The ports that were there, and when the folder had been changed last, in seconds since the epoch.
        self._seen: tuple[float, list[str]] = (-math.inf, [])

    def close(self) -> list[str]:
        """Close the ports whose one reader has died, and return them; remove those that are forgotten."""
        now = time.monotonic()
        old = {port for port, (_, since) in self._held.items() if since < now - _FORGOTTEN}
        # Who maps one still would send to it for ever: Fast DDS does not see of every reader that it is dead.
        self._end(sorted(old - _mapped(removed=True)) if old else [])
        latest = time.time() - _FRESH
        return [port for port in self._ports() if port not in self._held and self._closed(port, latest, now)]

    def end(self) -> None:
        """Remove all ports that are closed."""
        self._end([*self._held])

    def _ports(self) -> list[str]:
        """Return the ports that have a lock: hundreds of processes may end at once, among thousands of files."""
        try:
            changed = os.stat(_FOLDER).st_mtime  # noqa: PTH116 - as below
            if changed != self._seen[0]:
                # What comes in the same tick of the kernel's clock as what was seen changes no time stamp.
                settled = changed < time.time() - _TICK
                names = os.listdir(_FOLDER)  # noqa: PTH208 - without pathlib
                ports = [match[1] for name in names if (match := _READER.fullmatch(name))]
                self._seen = (changed if settled else -math.inf, ports)
        except OSError:
            return []
        return self._seen[1]

    def _closed(self, port: str, latest: float, now: float) -> bool:
        """Close a port, if its lock is ours, came before `latest` and is held by nobody."""
        held: list[int] = []
        lock = f"{port}_el"
        if not (_came_between(lock, 0.0, latest) and _lock(f"{_FOLDER}/{lock}", held) and held):
            for descriptor in held:
                os.close(descriptor)
            return False
        self._held[port] = (held.pop(), now)
        for file in (port, f"sem.{port}_mutex"):
            _unlinked(f"{_FOLDER}/{file}")
        with suppress(OSError):
            os.mkdir(f"{_FOLDER}/{port}")  # noqa: PTH102 - as above
        return True

    def _end(self, ports: list[str]) -> None:
        for port in ports:
            # The lock is held until all is gone.
            for file in (port, f"sem.{port}_mutex", f"{port}_el"):
                _unlinked(f"{_FOLDER}/{file}")
            os.close(self._held.pop(port)[0])


def _stems(began: float) -> set[str]:
    """Return the stems of all files of this user that came since then, or of which a part did."""
    try:
        if os.stat(_FOLDER).st_mtime < began - _TICK:  # noqa: PTH116 - as below
            return set()  # nothing has come or gone since
        names = os.listdir(_FOLDER)  # noqa: PTH208 - this runs in the keeper too, without pathlib
    except OSError:
        return set()
    matched = ((_OURS.fullmatch(name), name) for name in names)
    return {match[1] for match, name in matched if match and _came_since(name, began - _TICK)}


def _came_since(name: str, began: float) -> bool:
    return _came_between(name, began, math.inf)


def _came_between(name: str, began: float, latest: float) -> bool:
    """Tell by the time of the latest change through a descriptor: that is the begin, for the rest goes through maps."""
    try:
        status = os.lstat(f"{_FOLDER}/{name}")
    except OSError:
        return False
    return status.st_uid == os.geteuid() and began <= status.st_mtime <= latest


def _is_free(stem: str) -> bool:
    with _locked(stem) as free:
        return free


def _mapped(*, removed: bool = False) -> set[str]:
    """Return the stems of all that a process, as far as we may look at it, has in its memory; also if it is removed.

    Names of ports are the same in each container; those of one that has shared memory of its own are not meant.
    """
    found: set[str] = set()
    ours = os.stat(_FOLDER)  # noqa: PTH116 - as above
    for pid in filter(str.isdigit, os.listdir("/proc")):  # noqa: PTH208 - as above
        with suppress(OSError), open(f"/proc/{pid}/maps", "rb") as maps:  # noqa: PTH123 - as above
            names = (os.fsdecode(line.rpartition(b"/")[2].rstrip()) for line in maps if b"fastrtps_" in line)
            kept = (name.removesuffix(" (deleted)") if removed else name for name in names)
            stems = {match[1] for name in kept if (match := _OURS.fullmatch(name))}
            if stems - found and _sees(pid, ours):
                found |= stems
    return found


def _sees(pid: str, folder: os.stat_result) -> bool:
    """Tell whether a process has the same shared memory; so does one of which that cannot be told."""
    try:
        return os.path.samestat(os.stat(f"/proc/{pid}/root{_FOLDER}"), folder)  # noqa: PTH116 - as above
    except OSError:
        return True


def _remove(stem: str) -> list[str]:
    """Remove all files of a stem, unless somebody holds one of its locks."""
    with _locked(stem) as free:
        if not free:
            return []
        files = (stem, f"sem.{stem}_mutex", *(f"{stem}{suffix}" for suffix in _LOCKS))
        return [file for file in files if _unlinked(f"{_FOLDER}/{file}")]


@contextmanager
def _locked(stem: str) -> Iterator[bool]:
    """Hold the locks of a stem; the value says whether nobody else does."""
    held: list[int] = []
    try:
        free = all(_lock(f"{_FOLDER}/{stem}{suffix}", held) for suffix in _LOCKS)
        yield free and (bool(held) or not _came_since(stem, time.time() - _SETTLED))
    finally:
        for descriptor in held:
            os.close(descriptor)


def _lock(path: str, held: list[int]) -> bool:
    """Take a lock; a file that is not there is held by nobody."""
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_CLOEXEC)
    except FileNotFoundError:
        return True
    except OSError:
        return False
    held.append(descriptor)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True


def _unlinked(path: str) -> bool:
    """Remove a file, or the empty folder that stands for a port."""
    for remove in (os.unlink, os.rmdir):
        with suppress(OSError):
            remove(path)
            return True
    return False
