"""Files of packages that are looked at where they are written: whether an include by the package's name means them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.resolve.context import Packages

NOWHERE: Final = "/dev/null/"  # below which no file can be
_SHARE: Final = "/share/"


class Sources:
    """Packages of which those that are not installed have a share folder all the same, one that is not there."""

    def __init__(self, packages: Packages) -> None:
        self._packages = packages
        self.prefix = packages.prefix
        self.executable = packages.executable
        self.names = packages.names
        self.executables = packages.executables

    def share(self, package: str) -> str | None:
        """Return the share folder."""
        return self._packages.share(package) or f"{NOWHERE}share/{package}"


def shared(paths: Iterable[str]) -> set[str]:
    """Return how files of packages are called below the folders of all packages: `package/launch/file`."""
    return {path.rpartition(_SHARE)[2] for path in paths if _SHARE in path}


def is_source(path: str, names: set[str]) -> bool:
    """Return whether a file is, by its path, what one of these is installed from."""
    parts = path.split("/")
    return bool(names) and any("/".join(parts[first:]) in names for first in range(1, len(parts) - 1))
