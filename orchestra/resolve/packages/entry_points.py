"""Entry points of the installed distributions, by their group.

Read from `entry_points.txt` (packaging.python.org, "Entry points specification") without `importlib.metadata`, which
costs more to import than all of this.
"""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING, Final, NamedTuple

from orchestra.witness.looking import read

if TYPE_CHECKING:
    from collections.abc import Iterator

_KINDS: Final = (".dist-info", ".egg-info")


class EntryPoint(NamedTuple):
    """What a distribution declares; `owners` are the package that it is in and the one that it is shipped with."""

    name: str
    target: str
    owners: tuple[str, str]
    metadata: str


def declared(group: str) -> tuple[EntryPoint, ...]:
    """Return all entry points of a group, in the order of the import path."""
    return tuple(found for place in dict.fromkeys(sys.path) for found in _declared_in(place or ".", group))


def _declared_in(place: str, group: str) -> Iterator[EntryPoint]:
    try:
        names = sorted(os.listdir(place))  # noqa: PTH208 - pathlib is slow
    except OSError:
        return
    for kind in _KINDS:
        for name in names:
            if name.endswith(kind):
                shipped_with = name.partition("-")[0].removesuffix(".egg").replace(".", "_")
                metadata = os.path.join(place, name)  # noqa: PTH118 - as above
                for point, target in _listed(text_in(metadata), group):
                    package = target.partition(":")[0].strip().partition(".")[0]
                    yield EntryPoint(point, target, (package, shipped_with), metadata)


def text_in(metadata: str) -> str:
    """Return what a distribution declares, of which this is the folder; most declare nothing."""
    try:
        return read(f"{metadata}/entry_points.txt").decode()
    except (OSError, ValueError):
        return ""


def _listed(text_of_all: str, group: str) -> Iterator[tuple[str, str]]:
    """Yield the pairs of name and target of one distribution."""
    if f"[{group}]" not in text_of_all:
        return
    section = ""
    for line in text_of_all.splitlines():
        text = line.strip()
        if text.startswith("["):
            section = text
        elif section == f"[{group}]" and "=" in text and not text.startswith(("#", ";")):
            name, _, target = text.partition("=")
            yield name.strip(), target.partition("[")[0].strip()
