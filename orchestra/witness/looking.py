"""How things are in the file system, as texts and numbers that can be kept and compared."""

from __future__ import annotations

import os
import stat
import time
from typing import TYPE_CHECKING, Any, Final

from orchestra.witness.digest import digest_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from orchestra.witness.record import Signature

# Taken before anybody wraps them.
_stat, _lstat, _readlink, _access, _scandir = os.stat, os.lstat, os.readlink, os.access, os.scandir
_CHUNK: Final = 1 << 16

_FEW: Final = 128
_LATELY: Final[dict[str, bytes]] = {}

# Nanoseconds in which a file may be changed twice without a sign: clocks of file systems tick slowly.
_TICK: Final = 2_000_000_000
_WRITING: Final = os.O_WRONLY | os.O_RDWR | os.O_APPEND | os.O_CREAT | os.O_TRUNC


def signature(path: str) -> Signature | None:
    """Return what changes with the content of a file; None where there is no regular file."""
    try:
        found = _stat(path)
    except (OSError, ValueError):
        return None
    if not stat.S_ISREG(found.st_mode):
        return None
    return _signature_of(found)


def _signature_of(found: os.stat_result) -> Signature:
    return (found.st_mtime_ns, found.st_ctime_ns, found.st_size, found.st_ino, found.st_dev)


def is_writing(mode: str | None, flags: int) -> bool:
    """Tell whether a file is opened to be written; `mode` is that of `open`, None where flags alone are given."""
    if mode is None:
        return flags & _WRITING != 0
    return not {"w", "a", "x", "+"}.isdisjoint(mode)


def settled(found: Signature | None) -> bool:
    """Tell whether a file was last changed so long ago that another change would show in its signature."""
    return found is not None and time.time_ns() - max(found[0], found[1]) > _TICK


def content(path: str, found: bytes | None = None) -> str | None:
    """Return a digest of a file's content, of the reason where it cannot be read; None where it is no regular file.

    What a regular file has been `found` to hold is not read again.
    """
    try:
        if found is None:
            if not stat.S_ISREG(_stat(path).st_mode):
                return None
            found = read(path)
    except (OSError, ValueError) as error:
        return reason(error)
    if len(found) < _CHUNK:
        if len(_LATELY) >= _FEW:
            _LATELY.clear()
        _LATELY[path] = found
    return digest_of(found)


def read_lately(path: str) -> bytes:
    """Return what was in a small file when its digest was made, if that was just now; else what is in it."""
    known = _LATELY.get(path)
    return read(path) if known is None else known


def read(path: str) -> bytes:
    """Return what is in a file; without the objects that `open` makes, which take longer than a small file."""
    descriptor = os.open(path, os.O_RDONLY | os.O_CLOEXEC)
    try:
        parts = []
        while part := os.read(descriptor, _CHUNK):
            parts.append(part)
        return b"".join(parts)
    finally:
        os.close(descriptor)


def mode(path: str) -> Any:
    """Return kind and permissions of what a path leads to, or why that cannot be told."""
    return _told(lambda: _stat(path).st_mode)


def own_mode(path: str) -> Any:
    """Return kind and permissions of what is at a path itself, or why that cannot be told."""
    return _told(lambda: _lstat(path).st_mode)


def link(path: str) -> Any:
    """Return where a link leads to, or why that cannot be told."""
    return _told(lambda: os.fsdecode(_readlink(path)))


def told(kind: str, found: Any) -> Any:
    """Return what one of these looks has given, from what the function that was called gave."""
    return os.fsdecode(found) if kind == "link" else found.st_mode


def readable(path: str) -> Any:
    """Return for which accesses there is permission, as a number of three bits."""
    return _told(lambda: sum(bit for bit in (os.R_OK, os.W_OK, os.X_OK) if _access(path, bit)))


def listing(path: str) -> Any:
    """Return a digest of the names in a folder and of what each is, or why they cannot be listed."""

    def listed() -> str:
        with _scandir(path) as entries:
            return digest_of("\0".join(_described(entries)).encode("utf-8", "surrogateescape"))

    return _told(listed)


class Folders:
    """Lists folders; one that has not changed for long is listed once."""

    def __init__(self) -> None:
        self._known: dict[str, tuple[Signature, Any]] = {}

    def listing(self, path: str) -> Any:
        """Return what `listing` returns."""
        try:
            now = _signature_of(_stat(path))
        except (OSError, ValueError) as error:
            return reason(error)
        known = self._known.get(path)
        if known is not None and known[0] == now:
            return known[1]
        found = listing(path)
        if settled(now):
            self._known[path] = (now, found)
        return found


def names_of(names: Iterable[str]) -> str:
    """Return a text that stands for a set of names."""
    return digest_of("\0".join(sorted(names)).encode("utf-8", "surrogateescape"))


# Each kind of look by its name.
LOOKS: Final[dict[str, Callable[[str], Any]]] = {
    "mode": mode,
    "own_mode": own_mode,
    "link": link,
    "access": readable,
    "listing": listing,
}


# The functions that look without opening, and the kind of look that each is.
_LOOKING: Final = (("stat", "mode"), ("lstat", "own_mode"), ("readlink", "link"), ("access", "access"))


def wrap(wrapped: Callable[[Any, str], Any]) -> None:
    """Put what `wrapped` makes of them in the place of the functions that look without opening."""
    for name, kind in _LOOKING:
        function = getattr(os, name)
        found = wrapped(function, kind)
        setattr(os, name, found)
        for able in (os.supports_dir_fd, os.supports_fd, os.supports_follow_symlinks):
            if function in able:
                able.add(found)


def _described(entries: Iterable[os.DirEntry[str]]) -> list[str]:
    kinds = sorted((entry.name, entry.is_symlink(), entry.is_dir()) for entry in entries)
    return [f"{name}\1{linked:d}{folder:d}" for name, linked, folder in kinds if name != "__pycache__"]


def _told(look: Callable[[], Any]) -> Any:
    try:
        return look()
    except (OSError, ValueError) as error:
        return reason(error)


def reason(error: Exception) -> str:
    """Return a text for why something cannot be told."""
    return f"! {getattr(error, 'errno', None)}"
