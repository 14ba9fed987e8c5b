"""Declarations beside a package's parameters, found by the name of what they are about.

`share/PKG/params/EXEC.schema.json` (or in `config`, or `.yaml`) declares the parameters of every node that the
executable EXEC starts, and so does `EXEC_parameters.yaml` if it is a definition of generate_parameter_library, which
nothing else can be taken for. For a component EXEC is its class, `Talker` or `talker` of `demo::Talker`. Names that
are nodes' are not looked for: the launch file gives them, and may give any.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Final

from orchestra.location import is_file
from orchestra.patterns import pattern
from orchestra.witness.once import once

if TYPE_CHECKING:
    from collections.abc import Iterator

FOLDERS: Final = ("params", "config")
NODL_FOLDERS: Final = ("nodl", "")
_ENDINGS: Final = (".schema.json", ".schema.yaml", ".schema.yml")
_DEFINITION: Final = "_parameters.yaml"
SCHEMAS: Final = (*_ENDINGS, _DEFINITION)
INTERFACES: Final = (".interface.yaml", ".interface.yml", ".interface.json")
NODL: Final = (".nodl.yaml", ".nodl.yml", ".nodl.json")
NODL_XML: Final = ".nodl.xml"
_HUMP: Final = pattern(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])")


def endings_beside(share: str) -> frozenset[str] | None:
    """Return how the files of a package end that may declare something, for any executable; None where nobody can tell.

    Most packages have none: then nothing is looked for by the names of their executables.
    """
    return once(("endings", share), lambda: _endings(share))


def _endings(share: str) -> frozenset[str] | None:
    found: set[str] = set()
    known = (*SCHEMAS, *INTERFACES, *NODL, NODL_XML)
    for folder in dict.fromkeys((*FOLDERS, *NODL_FOLDERS)):
        try:
            names = os.listdir(f"{share}/{folder}")  # noqa: PTH208 - pathlib is slow
        except (FileNotFoundError, NotADirectoryError):
            continue
        except OSError:  # what cannot be listed may be read
            return None
        for name in names:
            found.update(ending for ending in known if name.endswith(ending))
    return frozenset(found)


def schema_beside(share: str, names: tuple[str, ...]) -> str | None:
    """Return the path of the schema for the first of these names that has one, in the share folder of a package."""
    return next((path for path in _candidates(share, names, _ENDINGS) if is_file(path)), None)


def definition_beside(share: str, names: tuple[str, ...]) -> str | None:
    """Return the path of a file that is called as definitions are."""
    return next((path for path in _candidates(share, names, (_DEFINITION,)) if is_file(path)), None)


def names_of_class(plugin: str) -> tuple[str, ...]:
    """Return what the files about a class may be called after."""
    name = plugin.rpartition("::")[2]
    return name, _HUMP.sub("_", name).lower()


def _candidates(share: str, names: tuple[str, ...], endings: tuple[str, ...]) -> Iterator[str]:
    for name in names:
        for folder in FOLDERS:
            for ending in endings:
                yield f"{share}/{folder}/{name}{ending}"
