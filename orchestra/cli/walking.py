"""Which files of a folder are there to be looked at: those of the project, not those that were made or installed in it.

Left out are hidden folders, links to folders (so that none is walked in a circle), folders that `COLCON_IGNORE` or
`AMENT_IGNORE` marks (as colcon marks build, install and log), virtual environments (`pyvenv.cfg`), caches of Python
and packages of node; what a `.gitignore` names, up to the root of the repository; and what `exclude` of the settings
names. None of that holds for what is named itself, nor for what is above it.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Final, NamedTuple

from orchestra.settings.globs import ignored, patterns

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.settings.find import Finder
    from orchestra.settings.globs import Pattern

_MARKS: Final = frozenset({"COLCON_IGNORE", "AMENT_IGNORE", "pyvenv.cfg"})
_NAMES: Final = frozenset({"__pycache__", "node_modules"})


class _Rules(NamedTuple):
    """The patterns of one `.gitignore`; they are relative to `folder`, which ends in a slash."""

    folder: str
    patterns: tuple[Pattern, ...]


def files_of_project(folder: str, finder: Finder) -> Iterator[str]:
    """Yield the files to be looked at below a folder, sorted by path; `finder` knows the settings."""
    top = os.path.abspath(folder)
    shown = os.path.normpath(folder)
    above = os.path.join(top, "")
    for path in _walked(top, _rules_above(top), finder):
        below = path.removeprefix(above)
        yield below if shown == "." else os.path.join(shown, below)


def _walked(folder: str, rules: tuple[_Rules, ...], finder: Finder) -> Iterator[str]:
    try:
        with os.scandir(folder) as found:
            entries = sorted(found, key=lambda entry: entry.name)
    except OSError:
        return  # somebody else's folder, or one that has just been removed
    rules = (*rules, *_rules_in(folder))
    for entry in entries:
        if not entry.is_dir(follow_symlinks=False):
            if not entry.is_dir() and not _left_out(entry.path, rules, finder, folder=False):
                yield entry.path
        elif not _is_marked(entry) and not _left_out(entry.path, rules, finder, folder=True):
            yield from _walked(entry.path, rules, finder)


def _is_marked(entry: os.DirEntry[str]) -> bool:
    if entry.name.startswith(".") or entry.name in _NAMES:
        return True
    return any(os.path.lexists(os.path.join(entry.path, mark)) for mark in _MARKS)


def _left_out(path: str, rules: tuple[_Rules, ...], finder: Finder, *, folder: bool) -> bool:
    settings = finder.settings(path)
    return (settings is not None and settings.excludes(path)) or _is_ignored(path, rules, folder=folder)


def _is_ignored(path: str, rules: tuple[_Rules, ...], *, folder: bool) -> bool:
    """Tell what the nearest `.gitignore` that says anything says."""
    for above, among in reversed(rules):
        said = ignored(path.removeprefix(above), among, folder=folder)
        if said is not None:
            return said
    return False


def _rules_above(folder: str) -> tuple[_Rules, ...]:
    """Return the rules of the repository that a folder is in; none where they leave out the folder itself."""
    above = [folder]
    while not os.path.lexists(os.path.join(above[-1], ".git")):
        parent = os.path.dirname(above[-1])
        if parent == above[-1]:
            return ()
        above.append(parent)
    rules: tuple[_Rules, ...] = ()
    for outer, inner in zip(above[:0:-1], above[-2::-1], strict=True):
        rules = (*rules, *_rules_in(outer))
        if _is_ignored(inner, rules, folder=True):
            return ()
    return rules


def _rules_in(folder: str) -> tuple[_Rules, ...]:
    try:
        with open(os.path.join(folder, ".gitignore"), encoding="utf-8", errors="replace") as file:
            return (_Rules(os.path.join(folder, ""), patterns(file.read())),)
    except OSError:
        return ()
