"""`ros2run.api`: the file that `ros2 run` starts."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.compat.ros2pkg.api import get_executable_paths

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["MultipleExecutables", "get_executable_path"]


class MultipleExecutables(Exception):
    """Several files of a package have the name that was asked for: `paths`."""

    def __init__(self, paths: Iterable[str]) -> None:
        super().__init__(paths)
        self.paths = paths


def get_executable_path(*, package_name: str, executable_name: str) -> str | None:
    """Return the path of an executable, None where the package has none of this name.

    Raises `ros2pkg.api.PackageNotFound` and `MultipleExecutables`.
    """
    every = get_executable_paths(package_name=package_name)
    found = [path for path in every if Path(path).name == executable_name]
    if len(found) > 1:
        raise MultipleExecutables(found)
    return found[0] if found else None
