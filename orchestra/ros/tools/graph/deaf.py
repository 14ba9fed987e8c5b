"""Who cannot answer: processes that are stopped, and those that were started with discovery off.

They have their ports as everybody has, so that they would be waited for. Whose a port is, /proc tells of all processes
into which this one may look; it is asked only where an answer is late.
"""

from __future__ import annotations

import os
import time
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

_LATE: Final = 0.15  # s, within which somebody answers who has time for it
_LOOK_AGAIN: Final = 0.05
_FOR_GOOD: Final = 0.1  # s, after which somebody who is stopped is taken to stay so
_PROC: Final = Path("/proc")
_STOPPED: Final = ("T", "t")
_OFF: Final = b"ROS_AUTOMATIC_DISCOVERY_RANGE=OFF"
_BEFORE_IT: Final = b"ROS_LOCALHOST_ONLY="  # where it is set, the other one does not count


class Deaf:
    """Those of this machine who cannot answer; `stopped` are the processes of them that are stopped."""

    def __init__(self) -> None:
        self._began = self._looked = time.monotonic()
        self._owners: dict[str, int | None] = {}  # by inodes; each is looked for once
        self._since: dict[int, float] = {}
        self._found: frozenset[int] = frozenset()
        self.stopped: frozenset[int] = frozenset()

    def among(self, missing: Mapping[int, str]) -> frozenset[int]:
        """Return those of these ports whose processes cannot answer; with each comes the inode of its socket."""
        now = time.monotonic()
        if missing and now - self._began >= _LATE and now - self._looked >= _LOOK_AGAIN:
            self._looked = now
            self._look(missing, now)
        return self._found & missing.keys()

    def _look(self, missing: Mapping[int, str], now: float) -> None:
        unknown = {f"socket:[{inode}]": inode for inode in missing.values() if inode not in self._owners}
        if unknown:
            self._owners |= dict.fromkeys(unknown.values())
            self._owners |= {unknown[link]: process for link, process in _links() if link in unknown}
        owners = {
            port: owner for port, inode in missing.items() if (owner := self._owners[inode]) is not None
        }
        self._since = {
            process: self._since.get(process, now) for process in owners.values() if is_stopped(process)
        }
        self.stopped = frozenset(one for one, since in self._since.items() if now - since >= _FOR_GOOD)
        self._found = frozenset(
            port for port, process in owners.items() if process in self.stopped or _is_off(process)
        )


def _links() -> Iterator[tuple[str, int]]:
    """Yield what each process has open."""
    for name in os.listdir(_PROC):  # noqa: PTH208 - texts, as fast as they come
        if not name.isdecimal():
            continue
        with suppress(OSError):  # it has ended, or is somebody else's
            for descriptor in os.scandir(_PROC / name / "fd"):
                with suppress(OSError):  # closed since
                    yield os.readlink(descriptor.path), int(name)  # noqa: PTH115 - as above


def is_stopped(process: int) -> bool:
    """Tell whether a process is stopped, as by SIGSTOP or a debugger."""
    try:
        status = (_PROC / str(process) / "stat").read_text("utf-8", "replace")
    except OSError:
        return False
    return status.rpartition(")")[2].split()[0] in _STOPPED


def _is_off(process: int) -> bool:
    try:
        variables = (_PROC / str(process) / "environ").read_bytes().split(b"\0")
    except OSError:
        return False
    return _OFF in variables and not any(one.startswith(_BEFORE_IT) for one in variables)
