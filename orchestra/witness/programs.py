"""The files of the code that a process runs, and whether they are still the same."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping


def signs(files: Iterable[str]) -> dict[str, list[int]]:
    """Return time and size of every file. Raises `OSError` where one is not there any more."""
    return {file: _sign(file) for file in sorted(files)}


def unchanged(files: Mapping[str, Any]) -> bool:
    """Tell whether each file is as `signs` has found it."""
    try:
        return all(_sign(file) == sign for file, sign in files.items())
    except (OSError, ValueError):
        return False


def _sign(file: str) -> list[int]:
    found = os.stat(file)
    return [found.st_mtime_ns, found.st_size]
