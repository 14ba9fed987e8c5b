"""Where the interface declarations of a package are, found by the name of the executable.

`share/PKG/params/EXEC.interface.yaml` (or in `config`, or `.json`) is our own form; `share/PKG/nodl/EXEC.nodl.yaml` (or
in the share folder itself, or `.json`) is NoDL 2; every `*.nodl.xml` in the last two folders is NoDL 1, which names its
executables itself. For a component EXEC is its class, as `orchestra.declared.convention` says.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Final

from orchestra.declared.convention import (
    FOLDERS,
    INTERFACES,
    NODL,
    NODL_FOLDERS,
    NODL_XML,
    endings_beside,
    names_of_class,
)
from orchestra.location import is_file
from orchestra.witness.once import once

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

_ENDINGS: Final = frozenset({*INTERFACES, *NODL, NODL_XML})


def may_be_declared(share: str, called: Iterable[str]) -> bool:
    """Return whether a file may declare one of these executables, or classes `pkg::Class`, of a package."""
    endings = endings_beside(share)
    if endings is not None and endings.isdisjoint(_ENDINGS):
        return False
    return any(_may_be_declared(share, name) for name in called)


def _may_be_declared(share: str, called: str) -> bool:
    return once(
        ("interfaces", share, called),
        lambda: own_file(share, called) is not None or next(nodl_files(share), None) is not None,
    )


def names_of(called: str) -> tuple[str, ...]:
    """Return what files about an executable, or the class `pkg::Class`, may be called after."""
    return names_of_class(called) if "::" in called else (called,)


def own_file(share: str, called: str) -> str | None:
    """Return the path of the declaration that is called after an executable."""
    return next((path for path in _by_name(share, names_of(called)) if is_file(path)), None)


def nodl_files(share: str) -> Iterator[str]:
    """Yield the paths of declarations that name their executables themselves."""
    for folder in NODL_FOLDERS:
        place = f"{share}/{folder}".rstrip("/")
        try:
            names = sorted(os.listdir(place))  # noqa: PTH208 - pathlib is slow
        except OSError:
            continue
        yield from (f"{place}/{name}" for name in names if name.endswith(NODL_XML))


def _by_name(share: str, names: tuple[str, ...]) -> Iterator[str]:
    for name in names:
        yield from (f"{share}/{folder}/{name}{ending}" for folder in FOLDERS for ending in INTERFACES)
        for folder in NODL_FOLDERS:
            place = f"{share}/{folder}".rstrip("/")
            yield from (f"{place}/{name}{ending}" for ending in NODL)
