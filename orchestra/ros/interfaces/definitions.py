"""Packages of definitions that can be imported like any other: `from my_interfaces.msg import Contacts`.

`install` names a package and the folder with its definitions: `msg/*.msg`, `srv/*.srv`, `action/*.action` (or `*.idl`
in any of them). From then on its modules are found as those of an installed package are. A definition is read when
a name of it is first asked for; its type support is made when rclpy first uses the class. A package of that name that
is really installed wins. With the first of them come the packages that Orchestra brings the definitions of, because
no wheel has them: tf2_msgs, composition_interfaces and robot_localization (two services of its filter).
"""

from __future__ import annotations

import sys
from importlib.machinery import ModuleSpec
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.ros.interfaces.serving import DefinedPackage, FilesOfKind, Kind, TypesOfFile

if TYPE_CHECKING:
    from collections.abc import Sequence
    from types import ModuleType

KINDS: Final = ("msg", "srv", "action")
PROVIDED: Final = ("composition_interfaces", "robot_localization", "tf2_msgs")
_FOLDER: Final = Path(__file__).parent / "provided"
_PARTS_OF_KIND = 2


def install(package: str, folder: str | Path) -> bool:
    """Make a package of definitions importable in this process; return whether that was needed.

    Nothing is read yet. A package that is installed for real is left as it is.
    """
    if is_here(package):
        return False
    _FINDER.folders[package] = Path(folder).absolute()
    if _FINDER not in sys.meta_path:
        sys.meta_path.insert(0, _FINDER)
    return True


def take_over(package: str, folder: Path) -> None:
    """Serve the modules of a package that is being imported of its definitions."""
    _FINDER.folders[package] = folder
    if _FINDER not in sys.meta_path:
        sys.meta_path.insert(0, _FINDER)


def provide(package: str) -> bool:
    """Make a package that Orchestra brings the definitions of importable; return whether that was needed."""
    return package in PROVIDED and install(package, provided_folder(package))


def provided_folder(package: str) -> Path:
    """Return the folder with the definitions of a package that Orchestra brings them of."""
    return _FOLDER / package


def is_here(package: str) -> bool:
    """Tell whether a package can be imported already."""
    return package in sys.modules or package in _FINDER.folders or _is_installed(package)


def _is_installed(package: str) -> bool:
    """Tell whether an import would find a package but for us; a folder without code is none (that of a source)."""
    finders = [finder for finder in sys.meta_path if finder is not _FINDER and hasattr(finder, "find_spec")]
    specs = (finder.find_spec(package, None) for finder in finders)
    return any(spec is not None and spec.origin is not None for spec in specs)


class _Finder:
    """Finds the modules of the packages that were installed here: before a folder of the same name is taken for one."""

    def __init__(self) -> None:
        self.folders: dict[str, Path] = {}

    def find_spec(
        self, name: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return the specification of a module of such a package."""
        del path, target
        package, *rest = name.split(".")
        if package in PROVIDED and package not in self.folders and not rest:
            provide(package)
        folder = self.folders.get(package)
        return _spec(name, rest, Kind(package, folder, rest[0] if rest else "")) if folder else None


def _spec(name: str, rest: Sequence[str], kind: Kind) -> ModuleSpec | None:
    if not rest:
        return ModuleSpec(name, DefinedPackage(kind.folder), origin=str(kind.folder), is_package=True)
    if rest[0] not in KINDS:
        return None
    if len(rest) == 1:
        return ModuleSpec(name, FilesOfKind(kind), origin=str(kind.folder / rest[0]), is_package=True)
    file = kind.file_of_module(rest[1]) if len(rest) == _PARTS_OF_KIND else None
    return ModuleSpec(name, TypesOfFile(kind, file), origin=str(file)) if file else None


_FINDER: Final = _Finder()
