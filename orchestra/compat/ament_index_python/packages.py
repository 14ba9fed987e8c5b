"""Where packages are installed. Python packages without ament are found by their names, as everywhere in Orchestra."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.compat.asked import keep_package
from orchestra.compat.seam import connection
from orchestra.nearest import nearest
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Callable

_NAME = pattern(r"[a-zA-Z0-9][a-zA-Z0-9_-]+")


class PackageNotFoundError(KeyError):
    """There is no such package here. `package` is its name, where Orchestra has looked for it."""

    package: str | None = None

    def __str__(self) -> str:
        """Return the message without the quotes that a `KeyError` puts around it."""
        return str(self.args[0]) if self.args else ""


def get_packages_with_prefixes() -> dict[str, str]:
    """Return the install prefix of every package by its name."""
    return connection().package_prefixes()


def get_package_prefix(package_name: str) -> str:
    """Return the install prefix of a package.

    Raises `ValueError` for what cannot be a name (REP 127), `PackageNotFoundError` for a package that is not here.
    """
    _check(package_name)
    prefix = connection().package_prefix(package_name)
    return _meant(package_name, connection().package_prefix) if prefix is None else prefix


def get_package_share_directory(package_name: str, print_warning: bool = True) -> str:
    """Return the share folder of a package; warns (`UserWarning`) where it does not exist.

    Raises `ValueError` and `PackageNotFoundError` as `get_package_prefix` does.
    """
    share = _share(package_name)
    if print_warning and not Path(share).exists():
        warnings.warn(_no_folder(package_name, share), stacklevel=2)
    return share


def get_package_share_path(package_name: str, print_warning: bool = True) -> Path:
    """Return the share folder of a package as a path, else as `get_package_share_directory`."""
    share = _share(package_name)
    if print_warning and not Path(share).exists():
        warnings.warn(_no_folder(package_name, share), stacklevel=2)
    return Path(share)


def _share(package_name: str) -> str:
    _check(package_name)
    share = connection().package_share(package_name)
    return _meant(package_name, connection().package_share) if share is None else share


def _meant(package_name: str, find: Callable[[str], str | None]) -> str:
    """Return the folder of the package that was meant, which is reported. Raises `PackageNotFoundError`."""
    # Here, because only mistakes need it, and what it imports.
    from orchestra.compat.packages_meant import package_meant  # noqa: PLC0415

    meant = package_meant(package_name)
    found = None if meant is None else find(meant)
    if found is None:
        raise _missing(package_name)
    return found


def _check(package_name: str) -> None:
    if _NAME.fullmatch(package_name) is None:
        # Here, because only mistakes need it, and what it imports.
        from orchestra.compat.packages_meant import no_name  # noqa: PLC0415

        raise no_name(package_name)


def _missing(package_name: str) -> PackageNotFoundError:
    meant = nearest(package_name, connection().package_prefixes())
    hint = f", did you mean {meant!r}?" if meant is not None else ""
    error = PackageNotFoundError(f"there is no package {package_name!r} here{hint}")
    error.package = package_name
    keep_package(error)
    return error


def _no_folder(package_name: str, share: str) -> str:
    return f"the share folder of {package_name!r} does not exist: {share}"
