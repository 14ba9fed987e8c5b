"""What a result always depends on, besides what is looked at: Orchestra itself, the interpreter, where it works."""

from __future__ import annotations

import os
from importlib.util import find_spec
from typing import TYPE_CHECKING, Final

from orchestra.witness.digest import digest_of
from orchestra.witness.standing import standing

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

_OURS: Final = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
_LIBRARIES: Final = ("pydantic", "pydantic_core", "yaml")


def identity(environment: Mapping[str, str]) -> str:
    """Return a text that is another one wherever something of that is."""
    parts = [*standing(environment), *_our_files(_OURS), *map(_library, _LIBRARIES)]
    return digest_of("\0".join(parts).encode("utf-8", "surrogateescape"))


def _our_files(folder: str) -> Iterator[str]:
    """Yield every file of ours with its size and time: while it is being worked on, the version says little."""
    with os.scandir(folder) as found:
        entries = sorted(found, key=lambda entry: entry.name)
    for entry in entries:
        if entry.is_dir(follow_symlinks=False):
            if entry.name != "__pycache__":
                yield from _our_files(entry.path)
        else:
            status = entry.stat()
            yield f"{entry.path} {status.st_size} {status.st_mtime_ns}"


def _library(name: str) -> str:
    """Return where a library is, and when it was put there."""
    spec = find_spec(name)
    if spec is None or spec.origin is None:
        return name
    status = os.stat(spec.origin)
    return f"{spec.origin} {status.st_size} {status.st_mtime_ns}"
