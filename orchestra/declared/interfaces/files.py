"""Interface declarations beside a package's parameters, found by the name of the executable.

`share/PKG/params/EXEC.interface.yaml` (or in `config`, or `.json`) is our own form; `share/PKG/nodl/EXEC.nodl.yaml` (or
beside `package.xml`, or `.json`) is NoDL 2; every `*.nodl.xml` in the last two folders is NoDL 1, which names its
executables itself. For a component EXEC is its class, as `orchestra.declared.convention` says.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Final

from orchestra.declared.convention import FOLDERS, names_of_class
from orchestra.declared.documents import read_document
from orchestra.declared.interfaces.own_form import read_interface
from orchestra.location import is_file

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.declared.interfaces.model import Interface
    from orchestra.errors import Problems
    from orchestra.location import Location

_OWN: Final = (".interface.yaml", ".interface.yml", ".interface.json")
_NODL: Final = (".nodl.yaml", ".nodl.yml", ".nodl.json")
_NODL_FOLDERS: Final = ("nodl/", "")
_NODL_XML: Final = ".nodl.xml"


def interface_of(share: str, called: str, named_at: Location, problems: Problems) -> Interface | None:
    """Return what an executable, or the class `pkg::Class`, declares; None where its package says nothing of it.

    `named_at` is where the description starts it.
    """
    names = names_of_class(called) if "::" in called else (called,)
    path = next((path for path in _by_name(share, names) if is_file(path)), None)
    if path is not None:
        document = read_document(path, named_at, problems)
        return None if document is None else read_interface(document, problems)
    for file in _nodl_files(share):
        # Here, because few packages have such files, and for the parser of XML.
        from orchestra.declared.interfaces.nodl_xml import read_nodl  # noqa: PLC0415

        found = read_nodl(file, named_at, problems)
        chosen = next((found[name] for name in names if name in found), None)
        if chosen is not None:
            return chosen
    return None


def _by_name(share: str, names: tuple[str, ...]) -> Iterator[str]:
    for name in names:
        yield from (f"{share}/{folder}/{name}{ending}" for folder in FOLDERS for ending in _OWN)
        yield from (f"{share}/{folder}{name}{ending}" for folder in _NODL_FOLDERS for ending in _NODL)


def _nodl_files(share: str) -> Iterator[str]:
    for folder in _NODL_FOLDERS:
        place = f"{share}/{folder}".rstrip("/")
        try:
            names = sorted(os.listdir(place))  # noqa: PTH208 - pathlib is slow
        except OSError:
            continue
        yield from (f"{place}/{name}" for name in names if name.endswith(_NODL_XML))
