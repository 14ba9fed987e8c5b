"""The arguments of a launch file and of the files it includes, as far as they are there to be seen."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

from orchestra.cli.glance.model import Glance, Places

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.cli.glance.model import Reader, SeenArgument
    from orchestra.resolve.packages import InstalledPackages

_READERS: Final = {
    ".yaml": "yaml_file",
    ".yml": "yaml_file",
    ".xml": "xml_file",
    ".launch": "xml_file",
    ".py": "python_file",
}
_LARGEST = 1 << 20  # bytes
_MOST_FILES = 500


class Declared(NamedTuple):
    """An argument, and the file that declares it. `conditional`: it, or an include on the way to it, may not count."""

    argument: SeenArgument
    file: str
    conditional: bool


def declared(path: str, packages: InstalledPackages) -> tuple[Declared, ...]:
    """Return the arguments that can be given to a launch file, in the order in which they are come upon, each once.

    Nothing is executed: includes are followed where their path is a constant. What an include gives itself is left
    out, as nobody else can give it. A file that cannot be read shows nothing.
    """
    found: dict[str, Declared] = {}
    for item in _Walk(packages).visit(path, frozenset(), conditional=False):
        known = found.setdefault(item.argument.name, item)
        if known.conditional and not item.conditional:
            found[item.argument.name] = item
    return tuple(found.values())


class _Walk:
    """Goes through files depth-first; the same file with the same arguments given is gone through once."""

    def __init__(self, packages: InstalledPackages) -> None:
        self._packages = packages
        self._glances: dict[str, Glance] = {}
        self._visited: set[tuple[str, frozenset[str], bool]] = set()

    def visit(self, path: str, given: frozenset[str], *, conditional: bool) -> Iterator[Declared]:
        key = (path, given, conditional)
        if key in self._visited or len(self._visited) >= _MOST_FILES:
            return
        self._visited.add(key)
        if path not in self._glances:
            self._glances[path] = glance(Places(path, self._packages.share, self._packages.prefix))
        seen = self._glances[path]
        for argument in seen.arguments:
            if argument.name not in given:
                yield Declared(argument, path, conditional or argument.conditional)
        for include in seen.includes:
            inner = str(Path(path).parent / include.path)
            within = conditional or include.conditional
            yield from self.visit(inner, given | include.given, conditional=within)


def glance(places: Places) -> Glance:
    """Return what one file shows, nothing where it cannot be read."""
    path = Path(places.path)
    name = _READERS.get(path.suffix.lower())
    if name is None:
        return Glance()
    reader: Reader = import_module(f"orchestra.cli.glance.{name}").glance
    try:
        if path.stat().st_size > _LARGEST:
            return Glance()
        return reader(path.read_text("utf-8-sig"), places)
    except (OSError, ValueError, SyntaxError, RecursionError):
        return Glance()  # what is wrong with it is told to whoever launches or checks it
