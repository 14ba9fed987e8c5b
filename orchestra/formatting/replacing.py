"""A file replaced by another content: whole or not at all, its permissions and whatever links to it kept."""

from __future__ import annotations

import errno
import os
import shutil
import stat
import tempfile
from contextlib import suppress
from pathlib import Path


def replace(path: Path, content: bytes) -> None:
    """Write a file anew. Raises `OSError` where that cannot be done; then the file is what it was.

    The content is written beside the file and put in its place when all of it is on the disk. A symbolic link stays
    one; a file that nobody may write is not replaced, whoever asks.
    """
    file = Path(os.path.realpath(path))
    before = file.stat()
    if not before.st_mode & (stat.S_IWUSR | stat.S_IWGRP | stat.S_IWOTH) or not os.access(file, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(path))
    descriptor, name = tempfile.mkstemp(prefix=f".{file.name}.", dir=file.parent)
    beside = Path(name)
    try:
        with os.fdopen(descriptor, "wb") as stream:
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())
        shutil.copystat(file, beside)
        os.utime(beside)
        if (before.st_uid, before.st_gid) != (os.geteuid(), beside.stat().st_gid):
            os.chown(beside, before.st_uid, before.st_gid)
        beside.replace(file)
    except BaseException:
        with suppress(FileNotFoundError):
            beside.unlink()
        raise
