"""Which settings count for a file: those nearest to it, upwards from its folder."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from orchestra.settings.read import OWN, SHARED, read

if TYPE_CHECKING:
    from orchestra.errors import Problems
    from orchestra.settings.model import Settings


def without_settings(path: str) -> bool:
    """Tell whether no folder above a file, an absolute path, has a file that may hold settings."""
    folder = os.path.dirname(path)  # noqa: PTH120 - pathlib is slow
    while True:
        if any(os.path.isfile(os.path.join(folder, name)) for name in (OWN, SHARED)):  # noqa: PTH113, PTH118 - as above
            return False
        above = os.path.dirname(folder)  # noqa: PTH120 - as above
        if above == folder:
            return True
        folder = above


class Finder:
    """Finds settings; each file is read once, and what is wrong with it is reported."""

    def __init__(self, problems: Problems) -> None:
        self._problems = problems
        self._folders: dict[str, Settings | None] = {}

    def settings(self, path: str) -> Settings | None:
        """Return the settings for a file, None where no folder above it has any."""
        return self.of_folder(os.path.dirname(path))  # noqa: PTH120 - pathlib is slow

    def of_folder(self, folder: str) -> Settings | None:
        """Return the settings for what stands in a folder, an absolute path."""
        if folder not in self._folders:
            above = os.path.dirname(folder)  # noqa: PTH120 - pathlib is slow
            found = self._here(folder)
            self._folders[folder] = found or (None if above == folder else self.of_folder(above))
        return self._folders[folder]

    def _here(self, folder: str) -> Settings | None:
        """Return the settings in a folder; where both files have some, those in the file of our own."""
        for name in (OWN, SHARED):
            path = os.path.join(folder, name)  # noqa: PTH118 - pathlib is slow
            if os.path.isfile(path) and (found := read(path, self._problems)) is not None:  # noqa: PTH113 - as above
                return found
        return None
