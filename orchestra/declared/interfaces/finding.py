"""Where the interface declarations of a package are, found by the name of the executable.

`share/PKG/params/EXEC.interface.yaml` (or in `config`, or `.json`) is our own form; `share/PKG/nodl/EXEC.nodl.yaml` (or
in the share folder itself, or `.json`) is NoDL 2; every `*.nodl.xml` in the last two folders is NoDL 1, which names its
executables itself. For a component EXEC is its class, as `orchestra.declared.convention` says.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Final

from orchestra.declared.convention import FOLDERS, names_of_class
from orchestra.location import is_file
from orchestra.witness.once import once

if TYPE_CHECKING:
    from collections.abc import Iterator

_OWN: Final = (".interface.yaml", ".interface.yml", ".interface.json")
_NODL: Final = (".nodl.yaml", ".nodl.yml", ".nodl.json")
_NODL_FOLDERS: Final = ("nodl/", "")
_NODL_XML: Final = ".nodl.xml"


def may_be_declared(share: str, called: str) -> bool:
    """Return whether there is a file that may declare an executable, or the class `pkg::Class`, of a package."""
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
    for folder in _NODL_FOLDERS:
        place = f"{share}/{folder}".rstrip("/")
        try:
            names = sorted(os.listdir(place))  # noqa: PTH208 - pathlib is slow
        except OSError:
            continue
        yield from (f"{place}/{name}" for name in names if name.endswith(_NODL_XML))


def _by_name(share: str, names: tuple[str, ...]) -> Iterator[str]:
    for name in names:
        yield from (f"{share}/{folder}/{name}{ending}" for folder in FOLDERS for ending in _OWN)
        yield from (f"{share}/{folder}{name}{ending}" for folder in _NODL_FOLDERS for ending in _NODL)
