"""Which files `orchestra check` looks at, and what each of them is.

A file that is named is always looked at. In a folder only what is plainly a launch file or a parameter file is: by
its name, else by a mark in its text. The text is searched, not parsed, so that a file with a syntax error is found.
"""

from __future__ import annotations

import os
import re
from typing import TYPE_CHECKING, Literal, TypeAlias

from orchestra.cli.walking import files_of_project
from orchestra.dataclass import dataclass
from orchestra.errors import Problems, UsageError
from orchestra.location import is_file
from orchestra.resolve.launch_files import TEXTS, is_launch_name, is_launch_text
from orchestra.settings.find import Finder

if TYPE_CHECKING:
    from collections.abc import Sequence

Kind: TypeAlias = Literal["launch", "parameters"]

_YAML_NAME = re.compile(r"\.ya?ml$")
# The key of every section, spelled as it may be by mistake.
_PARAMETERS_KEY = re.compile(
    r"""^[^#\n]*(?<![A-Za-z])ros[_-]*p[a-z]{1,4}m[a-z]{0,6}["']?\s*:""", re.MULTILINE | re.IGNORECASE
)
_PARAMETERS_PATH = re.compile(r"(?:^|/)(?:config|cfg|params?|parameters)/[^/]*$|param[^/]*$")
_KEY = re.compile(r"""^["']?[A-Za-z]\w*["']?\s*:""", re.MULTILINE)
_NODE_KEY = re.compile(r"""^["']?/[\w/*]*["']?\s*:""", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Target:
    """A file to look at."""

    path: str
    kind: Kind


def targets(paths: Sequence[str]) -> tuple[Target, ...]:
    """Return the files that the paths stand for, each once, those of a folder sorted by path.

    Raises `UsageError` for a path that does not exist and for a folder in which there is nothing to look at.
    """
    found: dict[str, Target] = {}
    folders: dict[str, str] = {}
    for path in paths:
        for target in _behind(path):
            found.setdefault(_real(target.path, folders), target)
    return tuple(found.values())


def kind_of(name: str, text: str) -> Kind | None:
    """Tell what a file is by its name and text, None where it is neither."""
    if is_launch_name(name) or is_launch_text(name, text):
        return "launch"
    return "parameters" if _YAML_NAME.search(name) and _PARAMETERS_KEY.search(text) else None


def _real(path: str, folders: dict[str, str]) -> str:
    """Return what `os.path.realpath` returns; `folders` are those that it was asked for."""
    folder, name = os.path.split(path)
    if not name:
        return os.path.realpath(path)
    if folder not in folders:
        folders[folder] = os.path.realpath(folder)
    whole = os.path.join(folders[folder], name)  # noqa: PTH118 - pathlib is slow
    return os.path.realpath(whole) if os.path.islink(whole) else whole  # noqa: PTH114 - pathlib is slow


def _behind(path: str) -> list[Target]:
    if is_file(path):
        return [Target(path, _kind_of_file(path, named=True) or "launch")]
    if not os.path.isdir(path):  # noqa: PTH112 - pathlib raises for paths that the system refuses
        raise UsageError(f"there is no file or folder {path}")
    files = files_of_project(path, Finder(Problems()))
    found = [Target(file, kind) for file in files if (kind := _kind_of_file(file))]
    if not found:
        raise UsageError(f"there is no launch file and no parameter file in {path}")
    return found


def _kind_of_file(path: str, *, named: bool = False) -> Kind | None:
    """Return what a file is; one that is named for itself may lack what marks a parameter file."""
    name = os.path.basename(path)  # noqa: PTH119 - pathlib is slow, here as below
    if is_launch_name(name):
        return "launch"
    if os.path.splitext(name)[1] not in TEXTS:  # noqa: PTH122
        return kind_of(name, "")
    try:
        with open(path, encoding="utf-8-sig", errors="replace") as file:  # noqa: PTH123
            text = file.read()
    except OSError:
        text = ""  # whoever checks it by its name will say that it cannot be read
    kind = kind_of(name, text)
    lacking = named and kind is None and _YAML_NAME.search(name) and _may_hold_parameters(path, text)
    return "parameters" if lacking else kind


def _may_hold_parameters(path: str, text: str) -> bool:
    """Return whether a file without the mark is rather one of parameters: by a node in it, or where it is."""
    return _NODE_KEY.search(text) is not None or (
        _PARAMETERS_PATH.search(path) is not None and _KEY.search(text) is not None and "launch" not in text
    )
