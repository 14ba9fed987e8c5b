"""Declarations beside a package's parameters, found by the name of what they are about.

`share/PKG/params/EXEC.schema.json` (or in `config`, or `.yaml`) declares the parameters of every node that the
executable EXEC starts, and so does `EXEC_parameters.yaml` if it is a definition of generate_parameter_library, which
nothing else can be taken for. For a component EXEC is its class, `Talker` or `talker` of `demo::Talker`. Names that
are nodes' are not looked for: the launch file gives them, and may give any.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.location import is_file
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Iterator

FOLDERS: Final = ("params", "config")
_ENDINGS: Final = (".schema.json", ".schema.yaml", ".schema.yml")
_DEFINITION: Final = "_parameters.yaml"
_HUMP: Final = pattern(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])")


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
