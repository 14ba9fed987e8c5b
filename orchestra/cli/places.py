"""The files and folders that the words of `orchestra check` stand for: paths, and those of packages."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from orchestra.errors import UsageError
from orchestra.nearest import nearest
from orchestra.resolve.launch_files import find_launch_file

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.resolve.context import Packages


def places(words: Sequence[str], packages: Packages) -> list[str]:
    """Return the paths: of a package alone its share folder, of one and a file, or both in one word, the file.

    Raises `UsageError` where a word is none of them.
    """
    found: list[str] = []
    left = tuple(words)
    while left:
        share = None if os.path.lexists(left[0]) else packages.share(left[0])
        if os.path.lexists(left[0]):
            found.append(left[0])
            left = left[1:]
        elif share is not None and (len(left) == 1 or os.path.lexists(left[1])):
            found.append(share)
            left = left[1:]
        else:
            path, left = _file(left, packages)
            found.append(path)
    return found


def _file(words: tuple[str, ...], packages: Packages) -> tuple[str, tuple[str, ...]]:
    first = words[0]
    if packages.share(first.partition("/")[0]) is not None:
        return find_launch_file(words, packages)
    meant = None if "/" in first else nearest(first, packages.names())
    hint = f"; did you mean the package '{meant}'?" if meant else ""
    raise UsageError(f"there is no file, folder or package {first}{hint}")
