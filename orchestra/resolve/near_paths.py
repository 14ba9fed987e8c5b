"""Paths of files that are not there, as they were probably meant: with names that are near, or in a folder beside."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.location import is_file
from orchestra.nearest import nearest
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

_WORD: Final = pattern(r"[a-z0-9]{2,}")
# Words that say only of what kind a file is.
_GENERAL: Final = frozenset(
    {
        "bringup",
        "config",
        "default",
        "file",
        "launch",
        "main",
        "param",
        "parameters",
        "params",
        "robot",
        "settings",
        "test",
    }
)


def near_path(path: Path, written: str) -> str | None:
    """Return how a path that does not exist was probably to be written: one with near names that does exist."""
    changes = near_names(path)
    return rewritten(written, changes) if changes else None


def near_names(path: Path) -> tuple[tuple[str, str], ...]:
    """Return the names in a path that are not there with those that were probably meant; none where one has no such.

    A file that is there in one folder below, or in one beside the folder that is named, was probably meant there.
    """
    there, names = path, list[str]()
    while not exists(there) and there != there.parent:
        names.insert(0, there.name)
        there = there.parent
    changes = list[tuple[str, str]]()
    for index, name in enumerate(names, start=1):
        near = name if exists(there / name) else _near(there, name, is_last=index == len(names))
        if near is None and len(names) == 1:
            near = _one_folder_below(there, name)
        if near is None:
            return _elsewhere(there, names[index - 1 :]) if not changes else ()
        if near != name:
            changes.append((name, near))
        there /= near
    return tuple(changes)


def related_names(path: Path) -> tuple[tuple[str, str], ...]:
    """Return the name of a file that is not there with the one in its folder that says the same in part; else nothing.

    Such is `ekf.yaml` for `ekf_params.yaml`: less than a near name, for a file that must be there all the same.
    """
    try:
        names = [entry.name for entry in path.parent.iterdir() if entry.is_file()]
    except (OSError, ValueError):
        return ()
    wanted = _said(path.name)
    shared = {name: len(wanted & _said(name)) for name in names if Path(name).suffix == path.suffix != ""}
    most = max(shared.values(), default=0)
    best = [name for name, number in shared.items() if number == most]
    return ((path.name, best[0]),) if most and len(best) == 1 else ()


def rewritten(written: str, changes: Iterable[tuple[str, str]]) -> str:
    """Return a path with names that are wrong replaced by those that were meant."""
    for name, near in changes:
        folder, slash, file = name.partition("/")
        if slash and name not in written and f"{folder}/" not in written:  # the folder is not written there
            written = _replaced(written, file, f"../{near}")
        else:
            written = _replaced(written, name, near)
    return written


def _elsewhere(there: Path, names: Sequence[str]) -> tuple[tuple[str, str], ...]:
    """Return the wrong part of a path with the right one, for a file that is there in another folder; else nothing.

    `names` are what is not there below a folder that is: the file, or its folder too.
    """
    *folders, name = names
    if not Path(name).suffix or len(folders) > 1:
        return ()
    folder, around = (folders[0], there) if folders else (there.name, there.parent)
    if is_file(str(around / name)):
        return ((f"{folder}/{name}", name),)
    found = _one_folder_below(around, name)
    if found is None or around.name == "share":  # that is another package
        return ()
    return ((folder, found.rpartition("/")[0]),) if folders else ((f"{folder}/{name}", found),)


def _one_folder_below(folder: Path, name: str) -> str | None:
    """Return the name of a file with the one folder below that has it, None where none or several have it."""
    try:
        found = [entry.name for entry in folder.iterdir() if (entry / name).is_file()]
    except (OSError, ValueError):
        return None
    return f"{found[0]}/{name}" if len(found) == 1 else None


def _near(folder: Path, name: str, *, is_last: bool) -> str | None:
    """Return the name in a folder that was probably meant; the endings alone make no two names alike.

    The last name of a path is that of a folder only where it has no ending.
    """
    is_file = is_last and bool(Path(name).suffix)
    try:
        names = [entry.name for entry in folder.iterdir() if not (is_file and entry.is_dir())]
    except (OSError, ValueError):
        return None
    stem = _stem(name)
    stems = {_stem(other) for other in names}
    meant = stem if stem in stems else nearest(stem, stems)
    alike = [other for other in names if _stem(other) == meant]
    return nearest(name, alike) or min(alike, default=None)


def _said(name: str) -> set[str]:
    """Return the words of a file's name that say what it is about."""
    return {word for word in _WORD.findall(_stem(name).lower()) if word not in _GENERAL}


def _stem(name: str) -> str:
    return name.partition(".")[0]


def _replaced(written: str, name: str, near: str) -> str:
    """Return a path with the last part of this name replaced."""
    before, found, after = written.rpartition(name)
    return f"{before}{near}{after}" if found else written


def exists(path: Path) -> bool:
    """Return whether a path is there."""
    try:
        return path.exists()
    except (OSError, ValueError):
        return False
