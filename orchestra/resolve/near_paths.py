"""Paths of files that are not there, as they were probably meant: with names that are near, or in a folder beside."""

from __future__ import annotations

import os
from functools import cached_property, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.location import is_file
from orchestra.nearest import may_look, nearest, renewals
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
_STEPS_OF_A_LOOK: Final = 3  # at a file, in steps of what is looked for


class _Listed:
    """What is in a folder. It is read once for a launch file, in which a thousand files of one folder may be missing.

    `files` and `folders` are names; `entries` are all of them by what stands before their first dot, `of_files` files.
    """

    def __init__(self, folder: str) -> None:
        self.files, self.folders = list[str](), list[str]()
        with os.scandir(folder) as entries:
            for entry in entries:
                (self.folders if entry.is_dir() else self.files).append(entry.name)

    @cached_property
    def of_files(self) -> dict[str, list[str]]:
        return _by_stem(self.files)

    @cached_property
    def entries(self) -> dict[str, list[str]]:
        return _by_stem([*self.files, *self.folders])

    @cached_property
    def said(self) -> dict[str, list[tuple[str, set[str]]]]:
        """Files by their ending, with what their names say."""
        found = dict[str, list[tuple[str, set[str]]]]()
        for name in self.files:
            found.setdefault(Path(name).suffix, []).append((name, _said(name)))
        return found


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
        near = name if exists(there / name) else _apart(there, name, names[index:])
        near = near or _near(there, name, is_last=index == len(names))
        if near is None and len(names) == 1:
            near = _one_folder_below(there, name)
        if near is None:
            return _doubled(there, names) or _elsewhere(there, names[index - 1 :]) if not changes else ()
        if near != name:
            changes.append((name, near))
        there /= near
    return tuple(changes)


def related_names(path: Path) -> tuple[tuple[str, str], ...]:
    """Return the name of a file that is not there with the one in its folder that says the same in part; else nothing.

    Such is `ekf.yaml` for `ekf_params.yaml`: less than a near name, for a file that must be there all the same.
    """
    listed = _listed(path.parent)
    alike = listed.said.get(path.suffix, ()) if listed is not None and path.suffix else ()
    if not may_look(len(alike)):
        return ()
    wanted = _said(path.name)
    shared = [(len(wanted & said), name) for name, said in alike]
    most = max((number for number, _ in shared), default=0)
    best = [name for number, name in shared if number == most]
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


def _apart(folder: Path, name: str, below: Sequence[str]) -> str | None:
    """Return a name with the slash that it lacks, as `demo/launch`, where all of the path is there then."""
    listed = _listed(folder)
    if listed is None or not may_look(len(listed.folders)):
        return None
    made = (f"{other}/{name[len(other) :]}" for other in listed.folders if name.startswith(other))
    return next((path for path in made if exists(folder.joinpath(path, *below))), None)


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


def _doubled(there: Path, names: Sequence[str]) -> tuple[tuple[str, str], ...]:
    """Return what is written once too often of a path, with the rest of it, for a file that is there without that.

    As `share/demo/launch/a.launch.py` behind the folder `share/demo`.
    """
    around = there.parts
    for count in range(1, len(names)):
        if tuple(names[:count]) == around[len(around) - count :] and is_file(
            str(there.joinpath(*names[count:]))
        ):
            return (("/".join(names[: count + 1]), names[count]),)
    return ()


def _one_folder_below(folder: Path, name: str) -> str | None:
    """Return the name of a file with the one folder below that has it, None where none or several have it."""
    listed = _listed(folder)
    if listed is None or not may_look(_STEPS_OF_A_LOOK * len(listed.folders)):
        return None
    found = [other for other in listed.folders if is_file(f"{folder}/{other}/{name}")]
    return f"{found[0]}/{name}" if len(found) == 1 else None


def _near(folder: Path, name: str, *, is_last: bool) -> str | None:
    """Return the name in a folder that was probably meant; the endings alone make no two names alike.

    The last name of a path is that of a folder only where it has no ending.
    """
    listed = _listed(folder)
    if listed is None:
        return None
    stem, stems = _stem(name), listed.of_files if is_last and Path(name).suffix else listed.entries
    meant = stem if stem in stems else nearest(stem, stems)
    alike = [] if meant is None else stems[meant]
    return nearest(name, alike) or min(alike, default=None)


def _listed(folder: Path) -> _Listed | None:
    """Return what is in a folder, None where it cannot be read."""
    return _read(str(folder), renewals())


@lru_cache(maxsize=32)
def _read(folder: str, _renewals: int) -> _Listed | None:
    try:
        return _Listed(folder)
    except (OSError, ValueError):
        return None


def _by_stem(names: Iterable[str]) -> dict[str, list[str]]:
    found = dict[str, list[str]]()
    for name in names:
        found.setdefault(_stem(name), []).append(name)
    return found


def _said(name: str) -> set[str]:
    """Return the words of a file's name that say what it is about."""
    return {word for word in _WORD.findall(_stem(name).lower()) if word not in _GENERAL}


def _stem(name: str) -> str:
    return name.partition(".")[0]


def _replaced(written: str, name: str, near: str) -> str:
    """Return a path with the last part of this name replaced."""
    before, found, after = written.rpartition(name)
    if found:
        return f"{before}{near}{after}"
    start, slash, end = near.rpartition("/")
    if slash and end and start + end == name:  # behind a substitution, as in `$(dirname)config`
        before, found, after = written.rpartition(f"){end}")
        return f"{before})/{end}{after}" if found else written
    return written


def exists(path: Path) -> bool:
    """Return whether a path is there."""
    try:
        return path.exists()
    except (OSError, ValueError):
        return False
