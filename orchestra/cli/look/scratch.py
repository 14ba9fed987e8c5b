"""The folder for temporary files of code, which is there as long as a check goes on."""

from __future__ import annotations

import os
from contextlib import contextmanager
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterator

_PREFIX: Final = "orchestra-check-"
_SETTINGS: Final = ("TMPDIR", "TEMP", "TMP")


@contextmanager
def scratch() -> Iterator[str]:
    """Yield a folder of this user's alone, which goes away with all that is in it.

    `tempfile` takes as long to import as four files to be looked at, and most often nothing is ever in the folder.
    """
    folder = _made()
    try:
        yield folder
    finally:
        _remove(folder)


def _made() -> str:
    place = next(filter(None, map(os.environ.get, _SETTINGS)), "/tmp")  # noqa: S108 - the name is drawn by lot
    folder = os.path.realpath(f"{place}/{_PREFIX}{os.urandom(8).hex()}")
    try:
        os.mkdir(folder, 0o700)  # noqa: PTH102 - pathlib is slow
    except OSError:
        import tempfile  # noqa: PLC0415 - see above; it knows more places

        return os.path.realpath(tempfile.mkdtemp(prefix=_PREFIX))
    return folder


def _remove(folder: str) -> None:
    try:
        os.rmdir(folder)  # noqa: PTH106 - pathlib is slow
    except FileNotFoundError:
        pass
    except OSError:
        import tempfile  # noqa: PLC0415 - see above; it removes also what nobody may read or write

        with tempfile.TemporaryDirectory(prefix=_PREFIX, dir=os.path.dirname(folder)) as whole:  # noqa: PTH120
            os.chmod(folder, 0o700)  # noqa: PTH101 - what cannot be written to cannot be moved
            os.rename(folder, f"{whole}/left")  # noqa: PTH104
