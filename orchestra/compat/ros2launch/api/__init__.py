"""`ros2launch.api`: launch files of packages, as `ros2 launch` finds them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.compat.ament_index_python.packages import get_package_share_directory

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = [
    "MultipleLaunchFilesError",
    "get_launch_file_paths",
    "get_share_file_path_from_package",
    "is_launch_file",
]

_ENDINGS = ("launch.py", "launch.xml", "launch.yaml", "launch.yml", ".launch")


class MultipleLaunchFilesError(Exception):
    """Several files of a package have the name that was asked for: `paths`."""

    def __init__(self, msg: str, paths: Iterable[str]) -> None:
        super().__init__(msg)
        self.paths = paths


def get_share_file_path_from_package(*, package_name: str, file_name: str) -> str:
    """Return the path of a file, wherever it is below the share folder of a package.

    Raises `PackageNotFoundError`, `FileNotFoundError` and `MultipleLaunchFilesError`.
    """
    share = Path(get_package_share_directory(package_name))
    found = sorted(str(file) for file in share.rglob(file_name) if file.name == file_name)
    if not found:
        told = f"there is no file {file_name!r} in the share folder of {package_name!r}, {share}"
        raise FileNotFoundError(told)
    if len(found) > 1:
        raise MultipleLaunchFilesError(f"several files of {package_name!r} are called {file_name!r}", found)
    return found[0]


def is_launch_file(path: str) -> bool:
    """Return whether a file is a launch file by its name."""
    return Path(path).is_file() and path.endswith(_ENDINGS)


def get_launch_file_paths(*, path: str) -> list[str]:
    """Return the paths of all launch files below a folder."""
    return sorted(str(file) for file in Path(path).rglob("*") if is_launch_file(str(file)))
