"""The socket of a run: made by its supervisor, found by its clients through a link in the run directory."""

from __future__ import annotations

import _socket
import os
import stat
import struct
from typing import TYPE_CHECKING, NamedTuple

from orchestra.control.place import ENDING, folders, inside, open_folder

if TYPE_CHECKING:
    import socket
    from pathlib import Path

    from orchestra.supervise.surroundings import Surroundings

# The link in the run directory.
LINK = "control.sock"
_CREDENTIALS = struct.Struct("3i")  # pid, uid and gid (SO_PEERCRED in unix(7))
_WAITING = 128


class Door(NamedTuple):
    """The descriptor of a socket that listens for the clients of a run, and the path of the socket.

    The first process of a run waits for it, and `socket` takes as long to import as twenty modules of ours: that one is
    left to those who talk.
    """

    listener: int
    path: str


def opened(around: Surroundings, run: str) -> Door | None:
    """Return the door of a run, to which a link in its directory leads; where there is none the user is told why."""
    try:
        door = Door(*listen(run))
    except OSError as error:
        around.journal.say(f"this run cannot be controlled: {told(error)}")
        return None
    try:
        link(around.folder, door.path)
    except OSError as error:
        around.journal.say(f"this run cannot be found by those who would control it: {told(error)}")
    return door


def told(error: OSError) -> str:
    """Return what an error of the system says, for people."""
    return f"{error.strerror or error}" + (f": {error.filename}" if error.filename else "")


def listen(run: str) -> tuple[int, str]:
    """Return what `Door` is made of. Raises `OSError` where there is no place for a socket."""
    *others, last = folders()
    for path in others:
        try:
            return _listen(path, run + ENDING)
        except OSError:
            continue
    return _listen(last, run + ENDING)


def _listen(path: str, name: str) -> tuple[int, str]:
    folder = open_folder(path, create=True)
    listener = _socket.socket(_socket.AF_UNIX, _socket.SOCK_STREAM | _socket.SOCK_NONBLOCK)
    before = os.umask(0o177)
    try:
        # Nobody ever sees it without a listener, which is what a dead run leaves.
        listener.bind(inside(folder, f".{name}"))
        listener.listen(_WAITING)
        os.rename(f".{name}", name, src_dir_fd=folder, dst_dir_fd=folder)
    except OSError:
        listener.close()
        raise
    finally:
        os.umask(before)
        os.close(folder)
    return listener.detach(), f"{path}/{name}"


def connect(path: str) -> socket.socket:
    """Return a connection to the socket at a path. Raises `OSError`, `PermissionError` where others may pose as it."""
    import socket  # noqa: PLC0415 - see `Door`

    where, _, name = path.rpartition("/")
    folder = open_folder(where)
    connection = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        connection.connect(inside(folder, name))
        if owner(connection) != os.getuid():
            raise PermissionError(1, "another user listens there", path)
    except OSError:
        connection.close()
        raise
    finally:
        os.close(folder)
    return connection


def owner(connection: socket.socket) -> int:
    """Return the user on the other side of a connection."""
    size = _CREDENTIALS.size
    uid: int = _CREDENTIALS.unpack(connection.getsockopt(_socket.SOL_SOCKET, _socket.SO_PEERCRED, size))[1]
    return uid


def is_stale(path: str) -> bool:
    """Tell whether a path is a socket of ours at which nobody listens."""
    try:
        if not stat.S_ISSOCK(os.lstat(path).st_mode):
            return False
        connect(path).close()
    except ConnectionRefusedError:
        return True
    except OSError:
        return False
    return False


def remove(path: str) -> None:
    """Remove a socket; nothing where it has gone, and nothing that is none. Raises `OSError`."""
    where, _, name = path.rpartition("/")
    try:
        folder = open_folder(where)
    except FileNotFoundError:
        return
    try:
        if stat.S_ISSOCK(os.stat(name, dir_fd=folder, follow_symlinks=False).st_mode):
            os.unlink(name, dir_fd=folder)
    except FileNotFoundError:
        return
    finally:
        os.close(folder)


def link(directory: Path, path: str) -> None:
    """Let clients find the socket of a run from its directory. Raises `OSError`."""
    (directory / LINK).symlink_to(path)


def linked(directory: Path) -> str | None:
    """Return the path of a run's socket, None where it has none."""
    try:
        return str((directory / LINK).readlink())
    except OSError:
        return None
