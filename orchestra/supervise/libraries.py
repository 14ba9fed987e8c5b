"""The shared libraries that the wheels bring along, in one folder of links.

The loader looks for each library of each program in every folder of LD_LIBRARY_PATH, and in some twenty folders of each
for other processors (ld.so(8), glibc-hwcaps). With the wheels' eleven folders that is two thirds of all that the kernel
does for a program like true(1), which needs one library, and none of theirs.

The folder is in the state folder, where the directory of each run is: who lives by it has more to lose there. It is
added to, and loses only links that lead nowhere, so whoever has it on his path keeps what he has found there.
"""

from __future__ import annotations

import os
from contextlib import suppress
from functools import cache
from typing import TYPE_CHECKING

from orchestra.fields import replace
from orchestra.supervise.host import this_host
from orchestra.supervise.runs.running import state_path
from orchestra.wheels import STAMP

if TYPE_CHECKING:
    from orchestra.supervise.environment import Host

_BUNDLED = ".libs"
# What stands for something else in LD_LIBRARY_PATH (ld.so(8)).
_UNFIT = frozenset(":;$")
_OTHERS_WRITE = 0o022


def host_of_run() -> Host:
    """Return what the interpreter's installation offers to the nodes of a run; the wheels' libraries are gathered."""
    return _gathered(state_path())


@cache  # nobody installs wheels for a process that runs
def _gathered(state: str) -> Host:
    return gathered(this_host(), f"{state}/libraries")


def gathered(host: Host, place: str) -> Host:
    """Return a host with one folder in `place` for all that bundle libraries; the same host where that cannot be."""
    bundled = tuple(folder for folder in host.libraries if folder.endswith(_BUNDLED))
    if len(bundled) < 2 or not _UNFIT.isdisjoint(place):  # noqa: PLR2004 - one is no more than one
        return host
    folder = f"{place}/{os.path.dirname(bundled[0]).replace('%', '%25').replace('/', '%')}"  # noqa: PTH120 - pathlib is slow
    try:
        _bring_up_to_date(folder, bundled)
    except OSError:
        return host
    rest = (one for one in host.libraries if one not in bundled)
    return replace(host, libraries=(*rest, folder), gathered=frozenset(bundled))


def _bring_up_to_date(folder: str, bundled: tuple[str, ...]) -> None:
    """Have a link for each library. Raises `OSError`, also where somebody else could put something there."""
    # As readable as a run directory: a launch prefix may change the user. Writable for nobody else, whatever the umask.
    os.makedirs(folder, 0o755, exist_ok=True)  # noqa: PTH103 - as above
    state = os.stat(folder)  # noqa: PTH116 - as above
    if state.st_uid != os.geteuid() or state.st_mode & _OTHERS_WRITE:
        raise PermissionError
    stamp = _stamp(bundled)
    if _read(f"{folder}/{STAMP}") == stamp:
        return
    wanted: dict[str, str] = {}
    for one in bundled:
        for name in os.listdir(one):  # noqa: PTH208 - as above
            wanted.setdefault(name, f"{one}/{name}")
    for name in os.listdir(folder):  # noqa: PTH208 - as above
        # What begins with a dot leads nowhere, or is what somebody else is about to put into its place.
        if not name.startswith(".") and not os.path.exists(f"{folder}/{name}"):  # noqa: PTH110 - as above
            with suppress(FileNotFoundError):
                os.unlink(f"{folder}/{name}")  # noqa: PTH108 - as above
    for name, target in wanted.items():
        _link(folder, name, target)
    _write(folder, STAMP, stamp)


def _stamp(bundled: tuple[str, ...]) -> bytes:
    """Return what changes when a library comes or goes: the time of that is its folder's."""
    facts = (f"{os.path.basename(folder)} {os.stat(folder).st_mtime_ns}\n" for folder in bundled)  # noqa: PTH116, PTH119
    return os.fsencode("".join(facts))


def _link(folder: str, name: str, target: str) -> None:
    """Let a link lead somewhere, at no moment nowhere: others may be at the same, with the same result."""
    if _target(f"{folder}/{name}") == target:
        return
    fresh = f"{folder}/.{os.getpid()}.{name}"
    os.symlink(target, fresh)  # noqa: PTH211 - as above
    os.replace(fresh, f"{folder}/{name}")  # noqa: PTH105 - as above


def _write(folder: str, name: str, content: bytes) -> None:
    """Write a file, as `_link` does it."""
    fresh = f"{folder}/.{os.getpid()}.{name}"
    with open(fresh, "wb") as file:  # noqa: PTH123 - as above
        file.write(content)
    os.replace(fresh, f"{folder}/{name}")  # noqa: PTH105 - as above


def _read(path: str) -> bytes | None:
    try:
        with open(path, "rb") as file:  # noqa: PTH123 - as above
            return file.read()
    except FileNotFoundError:
        return None


def _target(link: str) -> str | None:
    try:
        return os.readlink(link)  # noqa: PTH115 - as above
    except FileNotFoundError:
        return None
