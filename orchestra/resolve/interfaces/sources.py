"""Where packages of definitions are looked for as sources, and what they consist of.

In this order: the folders that `ORCHESTRA_INTERFACE_PATH` lists; then around a starting point (a package that needs
one, or the working directory). If that is in a folder called `src`, or has one, all that is below it; else the folder
that the package is in, two levels deep. As colcon does, nothing is looked for in a folder with COLCON_IGNORE,
AMENT_IGNORE or CATKIN_IGNORE in it, in a hidden one or inside of a package.
"""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

PATH: Final = "ORCHESTRA_INTERFACE_PATH"
KINDS: Final = ("msg", "srv", "action")
_PACKAGE_XML: Final = "package.xml"
_IGNORED: Final = frozenset({"COLCON_IGNORE", "AMENT_IGNORE", "CATKIN_IGNORE"})
_SHALLOW, _DEEP = 2, 12
_NAME: Final = re.compile(r"<name>\s*([^<\s]+)\s*</name>")
_COMMENT: Final = re.compile(r"<!--.*?-->", re.DOTALL)
_DEPENDENCY: Final = re.compile(
    r"<(?:depend|exec_depend|build_depend|build_export_depend|run_depend)\b[^>]*>\s*([^<\s]+)\s*<"
)
# A type of another package, in a definition or in IDL.
_OTHER: Final = re.compile(r"\b([a-z][a-z0-9_]*)(?:/(?:msg/)?|::msg::)[A-Z]\w*")


@dataclass(frozen=True, slots=True)
class Source:
    """A package of definitions: its name, its folder and the definition files relative to it."""

    name: str
    folder: Path
    files: tuple[Path, ...]


def in_folder(folder: Path, name: str | None = None) -> Source | None:
    """Return the package of definitions that a folder is, None where it has no definitions."""
    files = tuple(
        path.relative_to(folder)
        for kind in KINDS
        for path in sorted((folder / kind).glob("*"))
        if path.suffix in (f".{kind}", ".idl") and path.is_file()
    )
    if not files:
        return None
    # Of two files with one name, rosidl takes the one that is not IDL for the source of the other.
    written = {path.with_suffix("") for path in files if path.suffix != ".idl"}
    chosen = tuple(path for path in files if path.suffix != ".idl" or path.with_suffix("") not in written)
    return Source(name or name_of(folder), folder, chosen)


def name_of(folder: Path) -> str:
    """Return the name of the package in a folder: what `package.xml` says, else what the folder is called."""
    found = _NAME.search(_manifest(folder))
    return found[1] if found else folder.name


def dependencies(folder: Path) -> tuple[str, ...]:
    """Return the names that `package.xml` says a package needs when it is built or run."""
    return tuple(dict.fromkeys(_DEPENDENCY.findall(_manifest(folder))))


def mentioned(source: Source) -> frozenset[str]:
    """Return the names of the packages that may have types which the definitions use."""
    texts = (_text(source.folder / path) for path in source.files)
    return frozenset(name for text in texts for name in _OTHER.findall(text)) - {source.name}


def places(start: Path, environment: Mapping[str, str]) -> tuple[tuple[Path, int], ...]:
    """Return the folders to look in, and how deep."""
    listed = (Path(entry) for entry in environment.get(PATH, "").split(os.pathsep) if entry)
    return (*((folder, _DEEP) for folder in listed), _around(start))


def found_in(where: tuple[tuple[Path, int], ...]) -> dict[str, Source]:
    """Return the packages of definitions in some folders; of two with one name, the first."""
    found: dict[str, Source] = {}
    for folder, depth in where:
        for package in _packages(folder, depth):
            source = in_folder(package)
            if source is not None:
                found.setdefault(source.name, source)
    return found


def package_around(path: Path) -> Path | None:
    """Return the folder of the package that a file or folder is in."""
    return next((folder for folder in (path, *path.parents) if (folder / _PACKAGE_XML).is_file()), None)


def _around(start: Path) -> tuple[Path, int]:
    start = start.absolute()
    for folder in (start, *start.parents):
        if folder.name == "src":
            return folder, _DEEP
    if (start / "src").is_dir():
        return start / "src", _DEEP
    package = package_around(start)
    return (package.parent if package else start), _SHALLOW


def _packages(folder: Path, depth: int) -> Iterator[Path]:
    try:
        with os.scandir(folder) as entries:
            inside = sorted(entries, key=lambda entry: entry.name)
    except OSError:
        return
    names = {entry.name for entry in inside}
    if names & _IGNORED:
        return
    if _PACKAGE_XML in names:
        yield folder
        return
    if depth:
        for entry in inside:
            if not entry.name.startswith(".") and entry.is_dir():
                yield from _packages(Path(entry.path), depth - 1)


def _manifest(folder: Path) -> str:
    return _COMMENT.sub("", _text(folder / _PACKAGE_XML))


def _text(path: Path) -> str:
    try:
        return path.read_text("utf-8", errors="replace")
    except OSError:
        return ""
