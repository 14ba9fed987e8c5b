"""Results in a folder, each with what it depends on; safe with many that read and write at once.

An entry is replaced as a whole, and has a digest of itself: one that is damaged, or of another version, counts as none.
"""

from __future__ import annotations

import json
import os
import stat
import time
from contextlib import suppress
from typing import Any, BinaryIO, Final

from orchestra.witness.digest import digest_of
from orchestra.witness.place import entry
from orchestra.witness.record import Record

_MOST: Final = 64 * 1024 * 1024  # bytes that entries may take together
_DAY: Final = 86_400
_OF_OTHERS: Final = stat.S_IWGRP | stat.S_IWOTH


class Store:
    """The entries in one folder, which need not exist."""

    def __init__(self, folder: str, most: int = _MOST) -> None:
        self._folder = folder
        self._most = most

    def read(self, key: str) -> tuple[Record, Any, bytes] | None:
        """Return what a result depends on, the result, and its document; None where there is none to be read."""
        body = self.content(key)
        if body is None:
            return None
        told, _, document = body.partition(b"\n")
        try:
            found = json.loads(told)
            if found["key"] != key:
                return None
            return Record.from_data(found["record"]), found["result"], document
        except (ValueError, KeyError, TypeError, RecursionError):
            return None

    def write(self, key: str, record: Record, result: Any, document: bytes = b"") -> None:
        """Keep a result, in place of any earlier one. Where the disk refuses, nothing is kept.

        The result is JSON data; the document that belongs to it may be of any size, and is kept as it is.
        """
        if record.unknown:
            return
        told = json.dumps({"key": key, "record": record.whole().as_data(), "result": result})
        self.put(key, b"%b\n%b" % (told.encode(), document))

    def content(self, key: str) -> bytes | None:
        """Return what is kept with a key, as we have written it; None where there is nothing."""
        path = self._path(key)
        try:
            with open(path, "rb") as file:
                status = status_of_ours(file)
                if status is None:
                    return None
                digest, _, body = file.read().partition(b"\n")
        except (OSError, ValueError):
            return None
        if digest.decode("ascii", "replace") != digest_of(body):
            return None
        if time.time() - status.st_mtime > _DAY:
            with suppress(OSError):  # it was removed meanwhile, or belongs to somebody else
                os.utime(path)  # those that are used last are kept longest
        return body

    def put(self, key: str, body: bytes) -> None:
        """Keep a content, in place of any earlier one. Where the disk refuses, nothing is kept."""
        replaced(self._path(key), digest_of(body).encode() + b"\n" + body)

    def prune(self) -> None:
        """Remove what was not used for longest, if there is too much."""
        try:
            with os.scandir(self._folder) as found:
                entries = [
                    (status.st_mtime, status.st_size, item.path)
                    for item in found
                    if (status := _status(item))
                ]
        except OSError:
            return
        left = sum(size for _, size, _ in entries)
        for _, size, path in sorted(entries) if left > self._most else []:
            if left <= self._most // 2:
                break
            with suppress(OSError):  # somebody else has removed it
                os.unlink(path)
            left -= size

    def _path(self, key: str) -> str:
        return entry(self._folder, key)


def status_of_ours(file: BinaryIO) -> os.stat_result | None:
    """Return the status of an open file; None where somebody else may have written it."""
    status = os.fstat(file.fileno())
    return None if status.st_uid != os.geteuid() or status.st_mode & _OF_OTHERS else status


def replaced(path: str, content: bytes) -> None:
    """Have a file with this content in place of any earlier one, for us alone; none where the disk refuses."""
    own = f"{path}.{os.getpid()}"
    try:
        try:
            descriptor = _for_us_alone(own)
        except FileNotFoundError:
            os.makedirs(os.path.dirname(path), mode=0o700, exist_ok=True)
            descriptor = _for_us_alone(own)
        with open(descriptor, "wb") as file:
            file.write(content)
        os.replace(own, path)
    except OSError:
        with suppress(OSError):  # nothing could be written
            os.unlink(own)


def _for_us_alone(path: str) -> int:
    flags = os.O_WRONLY | os.O_CREAT | os.O_TRUNC | os.O_CLOEXEC
    return os.open(path, flags, 0o600)  # values of the environment are in it


def _status(entry: os.DirEntry[str]) -> os.stat_result | None:
    try:
        return entry.stat(follow_symlinks=False)
    except OSError:
        return None
