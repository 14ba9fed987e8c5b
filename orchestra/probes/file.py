"""Ready when a path exists.

A path below a mount whose server is gone blocks whoever asks for it, so on file systems that have a server, or a
program, behind them a process of its own asks.
"""

from __future__ import annotations

import os
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.probes.conversation import reason
from orchestra.probes.repeated import Repeated

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.probes.protocol import Cancel, Site

_WITHIN = 5.0
_ABSENT = "it does not exist"
# By the beginning of their type in /proc/self/mountinfo (proc_pid_mountinfo(5)).
_REMOTE = ("nfs", "cifs", "smb", "fuse", "ceph", "9p", "afs", "autofs", "gfs", "lustre", "ncp", "vboxsf")
# How that file writes a space, a tab, a new line and a backslash.
_ESCAPED = re.compile(r"\\([0-7]{3})")
_ASK = "import os, sys; sys.exit(0 if os.path.exists(sys.argv[1]) else 'it does not exist')"


def file_probe(path: str, interval: float) -> Repeated:
    """Return the condition that there is something by this path, from the working directory of the process."""

    def attempt(site: Site, told: Callable[[str | None], None]) -> Cancel | None:
        try:
            place = os.path.abspath(Path(site.folder or ".", path))  # noqa: PTH100 - must not touch the disk
        except OSError as error:  # our own working directory is gone
            told(reason(error))
            return None
        if remote(place, _mounts()):
            ask = (sys.executable, "-I", "-S", "-c", _ASK, place)
            return site.run(ask, _WITHIN, lambda result: told(result.fault))
        told(None if os.path.exists(place) else _ABSENT)  # noqa: PTH110 - never raises
        return None

    return Repeated(f"the file {path}", attempt, interval)


def remote(path: str, mounts: str) -> bool:
    """Tell whether a path lies on a file system that may not answer; `mounts` is as in /proc/self/mountinfo."""
    best, kind = "", ""
    for line in mounts.rstrip("\n").split("\n") if mounts else ():
        before, _, after = line.partition(" - ")
        point = _ESCAPED.sub(lambda found: chr(int(found[1], 8)), before.split(" ")[4])
        inside = path == point or path.startswith(point.rstrip("/") + "/")
        if inside and len(point) >= len(best):
            best, kind = point, after.split(" ")[0]
    return kind.startswith(_REMOTE)


def _mounts() -> str:
    try:
        return Path("/proc/self/mountinfo").read_text("utf-8", "surrogateescape")
    except OSError:
        return ""
