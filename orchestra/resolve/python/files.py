"""Where temporary files of user code are."""

from __future__ import annotations

import os
import stat
from contextlib import suppress
from typing import ClassVar


class Files:
    """The folder for temporary files; it is there when code of a launch file runs for the first time.

    It is made in the folder `above`, None where it goes to the usual place. Its name begins with `prefix`.
    """

    above: ClassVar[str | None] = None
    prefix: ClassVar[str] = "orchestra-"

    def __init__(self) -> None:
        self.folder: str | None = None
        self.kept = False

    @property
    def used(self) -> bool:
        """Whether there is a file in it: code may have removed it, or closed it even to us."""
        if self.folder is None:
            return False
        with suppress(OSError):
            if not os.access(self.folder, os.R_OK):
                os.chmod(self.folder, stat.S_IRWXU)  # noqa: PTH101 - pathlib is slow
            return bool(os.listdir(self.folder))  # noqa: PTH208 - no paths are wanted
        return False

    def keep(self, *, more: bool) -> str | None:
        """Let somebody else remove the folder; None where nothing is in it, nor will be: `more` says so."""
        self.kept = self.used or (more and self.folder is not None)
        return self.folder if self.kept else None
