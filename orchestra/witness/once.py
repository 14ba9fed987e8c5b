"""What is the same for all results of a process that is watched: it is found out once, and each depends on it."""

from __future__ import annotations

import os
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final, TypeVar

from orchestra.nearest import renewals
from orchestra.witness.observing import observer

if TYPE_CHECKING:
    from collections.abc import Callable

_FoundT = TypeVar("_FoundT")
_WATCHING: Final = observer()


def once(key: tuple[Any, ...], find: Callable[[], _FoundT]) -> _FoundT:
    """Return what `find` gives, which `key` and what it looks at decide; it is not called again for the same key.

    It is where this process is not watched, for nobody knows how long that goes on, and after anything of which nobody
    can say what depends on it, for that may have changed what is looked at.
    """
    if not _remembers():
        return find()
    watching = _WATCHING
    known = watching.kept.get(key)
    if known is not None:
        watching.depend(known[0])
        found: _FoundT = known[1]
        return found
    try:
        with watching.part() as record:
            found = find()
        if not record.unknown:
            watching.kept[key] = (record, found)
    finally:
        watching.depend(record)
    return found


def _remembers() -> bool:
    watching = _WATCHING
    return watching.installed and watching.certain and watching.record is not None and not watching.paused


def real(path: str) -> str:
    """Return what `os.path.realpath` returns; what is above a file is looked at once for all files of its folder.

    Where this process is not watched, it is for all that belong to one launch file.
    """
    if not path.startswith("/"):  # another working folder makes another one of it
        return os.path.realpath(path)
    folder, name = os.path.split(path)
    if name in ("", ".", "..") or "\0" in path:
        return once(("real", path), lambda: os.path.realpath(path))
    if not _WATCHING.installed:
        whole = os.path.join(_folder(folder, renewals()), name)
        return os.path.realpath(whole) if os.path.islink(whole) else whole
    return _seen(path) or _in(_real(folder), name, path) if _remembers() else os.path.realpath(path)


@lru_cache(maxsize=64)
def _folder(folder: str, renewal: int) -> str:
    """Return where a folder leads, as it was when so many launch files had been begun with."""
    del renewal
    return os.path.realpath(folder)


def _real(folder: str) -> str:
    return once(("real", folder), lambda: os.path.realpath(folder))


def _seen(path: str) -> str | None:
    """Return where a path leads that is no link itself, as it was seen before.

    What was seen is recorded as if it were seen again: a part of its own, for each file, would take longer to write.
    """
    known = _WATCHING.kept.get(("file", path))
    record = _WATCHING.record
    if known is None or record is None:
        return None
    _WATCHING.depend(known[0])
    whole, mode = known[1]
    record.looks.setdefault("own_mode", {}).setdefault(whole, mode)
    found: str = whole
    return found


def _in(folder: str, name: str, path: str) -> str:
    """Return where a path leads whose folder leads to this one."""
    whole = os.path.join(folder, name)
    if os.path.islink(whole):
        return once(("real", whole), lambda: os.path.realpath(whole))
    record = _WATCHING.record
    mode = None if record is None else record.looks.get("own_mode", {}).get(whole)
    above = _WATCHING.kept.get(("real", os.path.dirname(path)))
    if mode is not None and above is not None:
        _WATCHING.kept["file", path] = above[0], (whole, mode)
    return whole
