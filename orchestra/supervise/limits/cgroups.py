"""Where in the control groups of Linux (cgroups(7)) memory can be capped, in both versions of them.

With version 1 a group is made inside the supervisor's own. With version 2 a group that gives controllers to groups
below it may hold no process itself, except the root; so, unless a group above has been delegated to us and gives them
already, everything has to leave the own group first. Only a group that is ours alone is treated so: one that systemd
has delegated (`Delegate=yes`, which it marks with an attribute), or one that holds nobody but us.
"""

from __future__ import annotations

import contextlib
import os
from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass

if TYPE_CHECKING:
    from collections.abc import Iterable

MEMBERS = "cgroup.procs"
GIVEN = "cgroup.subtree_control"
_MARKS_OF_DELEGATION = ("user.delegate", "trusted.delegate")


@dataclass(frozen=True, slots=True)
class Hierarchy:
    """The mounted hierarchy that has the memory controller: its version, its root, and the folder of our own group."""

    version: int
    root: str
    own: str


@dataclass(frozen=True, slots=True)
class Place:
    """Where groups can be made; `vacate` says that all of us have to leave it first."""

    hierarchy: Hierarchy
    folder: str
    vacate: bool = False


def hierarchy(groups: str, mounts: str) -> Hierarchy | None:
    """Return the hierarchy for memory from the texts of /proc/self/cgroup and /proc/self/mountinfo, if it is mounted.

    A controller of version 1 is not there in version 2 (cgroups(7)).
    """
    paths: dict[str, str] = {}
    for line in groups.splitlines():
        _number, controllers, path = line.split(":", 2)
        paths.update(dict.fromkeys(controllers.split(","), path))
    found: dict[int, Hierarchy] = {}
    for line in mounts.splitlines():
        before, _, after = line.partition(" - ")
        kind, _source, options = after.split(" ", 2)
        fields = before.split(" ")
        top, root = (_unescaped(field) for field in fields[3:5])
        if kind == "cgroup" and "memory" in options.split(",") and "memory" in paths:
            found.setdefault(1, Hierarchy(1, root, _below(root, top, paths["memory"])))
        elif kind == "cgroup2" and "" in paths:
            found.setdefault(2, Hierarchy(2, root, _below(root, top, paths[""])))
    return found.get(1) or found.get(2)


def own_hierarchy() -> Hierarchy | None:
    """Return the hierarchy for memory as this process sees it."""
    groups, mounts = read("/proc/self/cgroup"), read("/proc/self/mountinfo")
    return None if groups is None or mounts is None else hierarchy(groups, mounts)


def find_place(found: Hierarchy | None, ours: Iterable[int]) -> Place | str:
    """Return where groups can be made, or why nowhere; `ours` are the processes that are ours to move."""
    if found is None:
        return "no hierarchy of control groups for memory is mounted"
    if found.version == 1:
        return Place(found, found.own) if _writable(found.own, MEMBERS) else _closed(found.own)
    given = _given_to_us(found)
    if given:
        return Place(found, given)
    if "memory" not in (read(f"{found.own}/cgroup.controllers") or "").split():
        return f"the memory controller is not there for {found.own}"
    if not _writable(found.own, MEMBERS, GIVEN):
        return _closed(found.own)
    if not os.path.exists(f"{found.own}/memory.max"):  # noqa: PTH110 - pathlib is slow to import, for the keeper
        return Place(found, found.own)  # the root, which may have both processes and groups
    strangers = set(members(found.own)) - set(ours)
    if strangers and not _delegated(found.own):
        return f"the control group {found.own} holds other processes too, and is not delegated to this one"
    return Place(found, found.own, vacate=True)


def members(folder: str) -> list[int]:
    """Return the processes in a group itself."""
    return [int(word) for word in (read(f"{folder}/{MEMBERS}") or "").split()]


def _given_to_us(found: Hierarchy) -> str | None:
    """Return the nearest group above that is delegated, gives memory to groups below it and holds no process."""
    for folder in upwards(found)[1:]:
        given = "memory" in (read(f"{folder}/{GIVEN}") or "").split()
        if given and _delegated(folder) and _writable(folder, MEMBERS):
            return folder
    return None


def upwards(found: Hierarchy) -> list[str]:
    """Return the folders of the own group and of those above it that can be seen."""
    folders = [found.own]
    while folders[-1] != found.root and folders[-1].startswith(f"{found.root}/"):
        folders.append(folders[-1].rpartition("/")[0])
    return folders


def _delegated(folder: str) -> bool:
    for name in _MARKS_OF_DELEGATION:
        with contextlib.suppress(OSError):
            if os.getxattr(folder, name) == b"1":
                return True
    return False


def _writable(folder: str, *files: str) -> bool:
    paths = (folder, *(f"{folder}/{file}" for file in files))
    return all(os.access(path, os.W_OK, effective_ids=True) for path in paths)


def _closed(folder: str) -> str:
    return f"no control group can be made in {folder}: it belongs to somebody else"


def _below(root: str, top: str, path: str) -> str:
    """Return the folder of a group: the mount shows only what is below `top` of the hierarchy."""
    inner = path.removeprefix(top) if top != "/" else path
    return f"{root}/{inner.strip('/')}".rstrip("/")


def _unescaped(field: str) -> str:
    return field.replace("\\040", " ").replace("\\011", "\t").replace("\\012", "\n").replace("\\134", "\\")


def read(path: str) -> str | None:
    """Return the text of a file of the kernel; None where it cannot be had."""
    try:
        with open(path, encoding="utf-8", errors="surrogateescape") as file:  # noqa: PTH123 - as above
            return file.read()
    except OSError:
        return None


def write(path: str, text: str) -> None:
    """Give a text to a file of the kernel, in one write. Raises `OSError`."""
    descriptor = os.open(path, os.O_WRONLY | os.O_CLOEXEC)
    try:
        os.write(descriptor, text.encode())
    finally:
        os.close(descriptor)
