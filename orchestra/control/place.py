"""Where control sockets are: in a folder of the user's own that nobody else can look into.

`$XDG_RUNTIME_DIR/orchestra` where there is such a folder (XDG base directory specification), else
`/tmp/orchestra-UID`. Anybody may have made the latter before us, so its owner is looked at, on the folder that is used
and not on a name that may mean another one a moment later. Imported by the keeper, so neither pathlib nor socket.
"""

from __future__ import annotations

import contextlib
import os
import stat

ENDING = ".sock"
_OTHERS = stat.S_IRWXG | stat.S_IRWXO


def folders() -> list[str]:
    """Return where sockets may be, the best place first."""
    runtime = os.environ.get("XDG_RUNTIME_DIR", "")
    ours = f"/tmp/orchestra-{os.getuid()}"  # noqa: S108 - `open_folder` looks whose it is
    return [f"{runtime}/orchestra", ours] if os.path.isabs(runtime) else [ours]  # noqa: PTH117 - see above


def open_folder(path: str, *, create: bool = False) -> int:
    """Return a descriptor of a folder that only this user can enter. Raises `OSError` where it is none."""
    if create:
        with contextlib.suppress(FileExistsError):
            os.mkdir(path, 0o700)  # noqa: PTH102 - see above
    folder = os.open(path, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC)
    try:
        facts = os.fstat(folder)
        if facts.st_uid != os.getuid():
            raise PermissionError(1, "it belongs to another user", path)
        if facts.st_mode & _OTHERS:
            os.fchmod(folder, 0o700)
    except OSError:
        os.close(folder)
        raise
    return folder


def inside(folder: int, name: str) -> str:
    """Return a path into an open folder that is short enough for a socket, whatever the folder's own is (unix(7))."""
    return f"/proc/self/fd/{folder}/{name}"


def forget(run: str) -> None:
    """Remove the socket of a run, with this mark, that lives no more."""
    for path in folders():
        with contextlib.suppress(OSError):
            folder = open_folder(path)
            try:
                os.unlink(run + ENDING, dir_fd=folder)
            finally:
                os.close(folder)
