"""Groups with a memory cap: one for each start of a process that has a cap, for it and all that it starts.

Each is called `orchestra-RUN.NAME`, and the run's id ends with the pid of its keeper: so whoever survives finds them
(`clear`). A group disappears when nothing of its process is left, and those of a dead supervisor when its keeper has
swept. Where all of us have to leave the place of the groups, they go to the group `orchestra-RUN.supervisor`.
"""

from __future__ import annotations

import contextlib
import os
from typing import TYPE_CHECKING

from orchestra.supervise.limits.cgroups import GIVEN, MEMBERS, members, own_hierarchy, read, upwards, write

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.supervise.limits.cgroups import Hierarchy, Place

_OURS = "orchestra-"
_SUPERVISOR = "supervisor"
# Whoever is forked while the others move has to be moved too.
_ROUNDS = 20


def name_of(run: str, process: str) -> str:
    """Return what the group of a process is called; `run` is the run's id."""
    return f"{_OURS}{run}.{process}"


def keeper_of(run: str) -> int:
    """Return the pid of the keeper of a run, with which the run's id ends."""
    return int(run.rpartition("-")[2])


def open_place(place: Place, run: str) -> None:
    """Let groups for memory be made in a place. Raises `OSError`."""
    if place.hierarchy.version == 1:
        return
    if place.vacate:
        refuge = f"{place.folder}/{name_of(run, _SUPERVISOR)}"
        os.mkdir(refuge)  # noqa: PTH102 - as above
        _move_all(place.folder, refuge)
    if "memory" not in (read(f"{place.folder}/{GIVEN}") or "").split():
        write(f"{place.folder}/{GIVEN}", "+memory")


def make_group(place: Place, name: str, memory: int) -> str:
    """Make a group that may use so many bytes, and return its folder. Raises `OSError`.

    Where memory runs out all of the group is ended, and none of it goes to swap: on a robot late is as bad as never.
    Version 1 ends one process of it at a time.
    """
    folder = f"{place.folder}/{name}"
    with contextlib.suppress(FileExistsError):
        os.mkdir(folder)  # noqa: PTH102 - as above
    if place.hierarchy.version == 1:
        write(f"{folder}/memory.limit_in_bytes", str(memory))
        _write_if_there(f"{folder}/memory.memsw.limit_in_bytes", str(memory))
    else:
        write(f"{folder}/memory.max", str(memory))
        _write_if_there(f"{folder}/memory.swap.max", "0")
        _write_if_there(f"{folder}/memory.oom.group", "1")
    return folder


def enter(folder: str) -> None:
    """Put the calling process into a group. Raises `OSError`."""
    write(f"{folder}/{MEMBERS}", "0")


def peak(folder: str) -> int | None:
    """Return the most bytes that a group has used; None where the kernel does not tell (before Linux 5.19)."""
    text = read(f"{folder}/memory.peak") or read(f"{folder}/memory.max_usage_in_bytes")
    return int(text) if text else None


def killed(folder: str) -> int:
    """Return how many processes the kernel has ended in a group because its memory was used up."""
    text = read(f"{folder}/memory.events") or read(f"{folder}/memory.oom_control") or ""
    counts = dict(line.split(" ", 1) for line in text.splitlines() if " " in line)
    return int(counts.get("oom_kill", 0))


def remove(folder: str) -> bool:
    """Remove a group; tell whether it is gone, which it is not while something runs in it."""
    try:
        os.rmdir(folder)  # noqa: PTH106 - as above
    except FileNotFoundError:
        return True
    except OSError:
        return False
    return True


def clear(keeper: int) -> list[str]:
    """Remove every group of the run of a keeper, and return the folders of those that cannot be removed.

    Called by the keeper or by what it started, when nothing else of the run is left.
    """
    found = own_hierarchy()
    return [] if found is None else clear_in(found, lambda name: _is_of(name, keeper))


def clear_run(run: str) -> list[str]:
    """Remove every group of a run that is dead, by its id, and return the folders of those that cannot be removed."""
    found = own_hierarchy()
    return [] if found is None else clear_in(found, lambda name: name.startswith(name_of(run, "")))


def clear_in(found: Hierarchy, ours: Callable[[str], bool]) -> list[str]:
    """Remove the groups whose names are `ours`, in the own group and those above it."""
    left: list[str] = []
    for folder in upwards(found):
        groups = [f"{folder}/{name}" for name in _names(folder) if ours(name)]
        refuges = [group for group in groups if group.endswith(f".{_SUPERVISOR}")]
        left.extend(group for group in groups if group not in refuges and not remove(group))
        for refuge in refuges:
            _leave(refuge, folder)
            if not remove(refuge):
                left.append(refuge)
    return left


def _leave(refuge: str, folder: str) -> None:
    """Go back to the group above, unless somebody else still has groups there."""
    if any(f"{folder}/{name}" != refuge for name in _names(folder)):
        return
    with contextlib.suppress(OSError):  # then it cannot be removed, which is told
        write(f"{folder}/{GIVEN}", "-memory")
        _move_all(refuge, folder)


def _is_of(name: str, keeper: int) -> bool:
    run = name.removeprefix(_OURS).partition(".")[0]
    return name.startswith(_OURS) and run.endswith(f"-{keeper}")


def _names(folder: str) -> list[str]:
    try:
        with os.scandir(folder) as entries:
            return [entry.name for entry in entries if entry.is_dir(follow_symlinks=False)]
    except OSError:
        return []


def _move_all(source: str, target: str) -> None:
    for _ in range(_ROUNDS):
        pids = members(source)
        if not pids:
            return
        for pid in pids:
            with contextlib.suppress(ProcessLookupError):
                write(f"{target}/{MEMBERS}", str(pid))


def _write_if_there(path: str, text: str) -> None:
    with contextlib.suppress(FileNotFoundError, PermissionError):  # without swap, or an older kernel
        write(path, text)
