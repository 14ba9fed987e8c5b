"""What is the same for all results of a process that is watched: it is found out once, and each depends on it."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Final, TypeVar

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
    watching = _WATCHING
    if not (watching.installed and watching.certain and watching.active):
        return find()
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


def real(path: str) -> str:
    """Return what `os.path.realpath` returns; what is above a file is looked at once for all files of its folder."""
    if not path.startswith("/"):  # another working folder makes another one of it
        return os.path.realpath(path)
    return once(("real", path), lambda: _real(path))


def _real(path: str) -> str:
    folder, name = os.path.split(path)
    if name in ("", ".", "..") or "\0" in path:
        return os.path.realpath(path)
    whole = os.path.join(once(("real", folder), lambda: os.path.realpath(folder)), name)
    return os.path.realpath(whole) if os.path.islink(whole) else whole
