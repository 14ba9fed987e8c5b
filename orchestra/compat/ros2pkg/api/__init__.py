"""`ros2pkg.api`: packages and their executables, as `ros2 pkg` knows them."""

from __future__ import annotations

import os
from pathlib import Path

from orchestra.compat.ament_index_python.packages import (
    PackageNotFoundError,
    get_package_prefix,
    get_packages_with_prefixes,
)

__all__ = ["PackageNotFound", "get_executable_paths", "get_package_names", "get_prefix_path"]


class PackageNotFound(PackageNotFoundError):
    """There is no such package."""

    def __init__(self, package_name: str) -> None:
        super().__init__(f"there is no package {package_name!r} here")
        self.package = self.package_name = package_name


def get_package_names() -> list[str]:
    """Return the names of all packages."""
    return list(get_packages_with_prefixes())


def get_prefix_path(package_name: str) -> str | None:
    """Return the install prefix of a package, None for an unknown one."""
    try:
        return get_package_prefix(package_name)
    except PackageNotFoundError:
        return None


def get_executable_paths(*, package_name: str) -> list[str]:
    """Return the paths of the executables of a package, in order. Raises `PackageNotFound`."""
    prefix = get_prefix_path(package_name)
    if prefix is None:
        raise PackageNotFound(package_name)
    files = Path(prefix, "lib", package_name).rglob("*")
    return sorted(str(file) for file in files if file.is_file() and os.access(file, os.X_OK))
