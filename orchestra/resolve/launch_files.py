"""Launch files as people name them: by path, or by package and file name (`ros2 launch`)."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.errors import UsageError
from orchestra.location import is_file
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.resolve.context import Packages


def find_launch_file(words: Sequence[str], packages: Packages) -> tuple[str, tuple[str, ...]]:
    """Return the absolute path of the launch file that the first words name, and the words after it.

    A first word that is a file is a path; otherwise the first two are a package and the name of a file anywhere in
    its share folder. Raises `UsageError` where there is no such file, or more than one.
    """
    first, rest = words[0], tuple(words[1:])
    if ":=" in first:
        raise UsageError(f"the launch file comes before its arguments, '{first}' is one")
    if is_file(first):
        return os.path.normpath(Path.cwd() / first), rest
    if os.sep in first or not rest or ":=" in rest[0]:
        if os.path.lexists(first):
            raise UsageError(f"{first} is there, but it is no file")
        raise UsageError(f"there is no launch file {first}" + _hint(Path(first)))
    share = packages.share(first)
    if share is None:
        meant = nearest(first, packages.names())
        raise UsageError(f"there is no package '{first}'" + (f": did you mean '{meant}'?" if meant else ""))
    return _in_share(Path(share), first, rest[0]), rest[1:]


def _in_share(share: Path, package: str, name: str) -> str:
    found = sorted(path for path in share.rglob(Path(name).name) if path.is_file() and path.match(name))
    if len(found) == 1:
        return str(found[0])
    if found:
        places = ", ".join(str(path.relative_to(share)) for path in found)
        raise UsageError(f"the package '{package}' has more than one {name}: {places}")
    names = {
        path.name for path in share.rglob("*") if path.suffix in {".py", ".xml", ".yaml", ".yml", ".launch"}
    }
    meant = nearest(name, names)
    hint = f": did you mean '{meant}'?" if meant else ""
    raise UsageError(f"the package '{package}' has no launch file {name}{hint}")


def _hint(path: Path) -> str:
    """Return a question about a file in the same folder that was probably meant."""
    folder = path.parent
    try:
        meant = nearest(path.name, [entry.name for entry in folder.iterdir()])
    except OSError:
        return ""
    return f": did you mean {folder / meant}?" if meant else ""
