"""Which interfaces there are: the resource `rosidl_interfaces` of the ament index, one file per line, and sources."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.errors import RunError
from orchestra.nearest import nearest
from orchestra.resolve.interfaces.available import available
from orchestra.resolve.packages import ament

if TYPE_CHECKING:
    from collections.abc import Mapping

KINDS: Final = {"msg": "Messages", "srv": "Services", "action": "Actions"}
_RESOURCE: Final = Path("share", "ament_index", "resource_index", "rosidl_interfaces")
_PARTS: Final = 3


class Interfaces:
    """The interfaces that an environment shows; of a package in two prefixes, the first counts."""

    def __init__(self, environment: Mapping[str, str]) -> None:
        self._folders: dict[str, Path] = {}
        self._texts: dict[str, str] = {}
        for prefix in ament.prefixes(environment):
            folder = prefix / _RESOURCE
            if folder.is_dir():
                for marker in folder.iterdir():
                    if not marker.name.startswith(".") and marker.name not in self._folders:
                        self._folders[marker.name] = prefix / "share" / marker.name
                        self._texts[marker.name] = marker.read_text("utf-8")
        for source in available(Path.cwd(), environment).values():
            if source.name not in self._folders:
                self._folders[source.name] = source.folder
                self._texts[source.name] = "".join(f"{path.as_posix()}\n" for path in source.files)

    def packages(self, kinds: tuple[str, ...] = tuple(KINDS)) -> list[str]:
        """Return the packages that have interfaces of these kinds."""
        return sorted(package for package in self._texts if self.of(package, kinds))

    def of(self, package: str, kinds: tuple[str, ...] = tuple(KINDS)) -> list[str]:
        """Return the full names of the interfaces of a package."""
        text = self._texts.get(package, "")
        lines = {line.strip().rpartition(".")[0] for line in text.splitlines() if "." in line}
        found = {f"{package}/{line}" for line in lines}
        return sorted(name for name in found if name.split("/")[1] in kinds and name.count("/") == _PARTS - 1)

    def all(self, kinds: tuple[str, ...] = tuple(KINDS)) -> list[str]:
        """Return the full names of all interfaces of these kinds."""
        return [name for package in self.packages(kinds) for name in self.of(package, kinds)]

    def text(self, name: str) -> str:
        """Return the definition of an interface. Raises `RunError` where there is none."""
        parts = name.split("/")
        if len(parts) != _PARTS or parts[1] not in KINDS:
            raise RunError(f"'{name}' is not the full name of an interface, as std_msgs/msg/String")
        package, kind, local = parts
        if package not in self._texts:
            raise RunError(f"{name}: {self.unknown_package(package)}")
        folder = self._folders[package] / kind
        for path in (folder / f"{local}.{kind}", folder / f"{local}.idl"):
            if path.is_file():
                return path.read_text("utf-8")
        raise RunError(f"{name}: package {package} has no such interface{_hint(name, self.of(package))}")

    def unknown_package(self, package: str) -> str:
        """Return what to say of a package that has no interfaces here."""
        return f"there is no package {package} with interfaces{_hint(package, self.packages())}"


def _hint(word: str, known: list[str]) -> str:
    near = nearest(word, known)
    return f"; did you mean {near}?" if near else ""
