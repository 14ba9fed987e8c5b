"""Words of the commands that name packages, launch files, arguments and executables."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.cli.completing.candidates import Candidate
from orchestra.cli.completing.paths import paths
from orchestra.cli.glance.walk import declared
from orchestra.errors import UsageError
from orchestra.location import is_file
from orchestra.resolve.launch_files import find_launch_file, is_launch_file, launch_files, short_name
from orchestra.resolve.packages import InstalledPackages

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.cli.glance.model import SeenArgument

_BOOLEANS = ("true", "false")


def launch_words(before: Sequence[str], begun: str) -> Iterator[Candidate]:
    """Yield what may follow in `orchestra launch`: a file or package, a file of the package, arguments."""
    packages = InstalledPackages(os.environ)
    if not before:
        yield from _places(begun, packages)
        return
    if len(before) == 1 and not is_file(before[0]):
        yield from _files_of(before[0], packages)
    try:
        file, given = find_launch_file(before, packages)
    except UsageError:
        return  # there is no such file: nothing is known about its arguments
    yield from _arguments(file, given, begun, packages)


def check_words(before: Sequence[str], begun: str) -> Iterator[Candidate]:
    """Yield what may follow in `orchestra check`: files, folders and packages; arguments of the files."""
    packages = InstalledPackages(os.environ)
    yield from _places(begun, packages)
    if before and not Path(before[-1]).exists():
        yield from _files_of(before[-1], packages)
    for word in before:
        if is_file(word):
            yield from _arguments(word, before, begun, packages)


def run_words(before: Sequence[str], begun: str) -> Iterator[Candidate]:
    """Yield what may follow in `orchestra run`: a package, one of its executables, words of the node."""
    packages = InstalledPackages(os.environ)
    if not before:
        yield from map(Candidate, packages.names())
    elif len(before) == 1:
        yield from map(Candidate, packages.executables(before[0]))
    else:
        yield from paths(begun)


def _places(begun: str, packages: InstalledPackages) -> Iterator[Candidate]:
    yield from paths(begun, is_launch_file)
    package, separator, _ = begun.partition("/")
    if not separator:
        yield from (Candidate(name, "package") for name in packages.names())
    elif not Path(package).exists() and (share := packages.share(package)) is not None:
        for name, file in _short_names(Path(share)).items():
            yield Candidate(f"{package}/{name}", file)


def _files_of(package: str, packages: InstalledPackages) -> Iterator[Candidate]:
    share = packages.share(package)
    if share is not None:
        yield from (Candidate(path.name) for path in launch_files(Path(share)))


def _short_names(share: Path) -> dict[str, str]:
    """Return the short names that only one file has, with its place in the share folder."""
    found: dict[str, list[Path]] = {}
    for path in launch_files(share):
        found.setdefault(short_name(path.name), []).append(path)
    return {name: str(files[0].relative_to(share)) for name, files in found.items() if len(files) == 1}


def _arguments(
    file: str, given: Sequence[str], begun: str, packages: InstalledPackages
) -> Iterator[Candidate]:
    name, separator, value = begun.partition(":=")
    known = {item.argument.name: item.argument for item in declared(file, packages)}
    if not separator:
        taken = {word.partition(":=")[0] for word in given}
        for argument in known.values():
            if argument.name not in taken:
                yield Candidate(f"{argument.name}:=", _told(argument), open=True)
        return
    values = _values(known[name]) if name in known else ()
    yield from (Candidate(f"{name}:={value}") for value in values)
    if not values or os.sep in value:
        for path in paths(value):
            yield path._replace(word=f"{name}:={path.word}")


def _values(argument: SeenArgument) -> tuple[str, ...]:
    if argument.choices:
        return argument.choices
    if argument.default is None or not argument.constant:
        return ()
    if argument.default.lower() in _BOOLEANS:
        return _BOOLEANS if argument.default.islower() else tuple(map(str.capitalize, _BOOLEANS))
    return (argument.default,) if argument.default else ()


def _told(argument: SeenArgument) -> str:
    default = "required" if argument.default is None else f"default: {argument.default}"
    return f"{argument.description} ({default})" if argument.description else f"({default})"
