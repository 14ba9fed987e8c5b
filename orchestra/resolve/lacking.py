"""Programs and files that are not here, and may be on another machine: what is to be said of them."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.errors import HERE, Severity
from orchestra.location import displayed, is_file
from orchestra.nearest import is_one_slip, nearest
from orchestra.resolve.near_paths import near_names, rewritten
from orchestra.resolve.refusals import Missing

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from orchestra.resolve.context import Packages

_SHORT: Final = 4  # letters


def missing_program(name: str, environment: Mapping[str, str], weight: Severity) -> Missing:
    """Return what is to be said of a program that is not on the PATH: of such a weight unless one slip explains it.

    A PATH has a thousand short names: `socat` is no slip for `cat`, nor `gzserver` for `serialver`, nor `ipfs` for
    `ipcs`.
    """
    known = set(_programs(environment.get("PATH", os.defpath)))
    slip = nearest(name, (program for program in known if _is_slip(name, program)))
    if weight is Severity.ERROR or slip is not None:
        return Missing(
            Severity.ERROR, f"there is no program {name!r} on the PATH", slip or nearest(name, known)
        )
    return Missing(weight, f"there is no program {name!r} {HERE}", None)


def _is_slip(name: str, program: str) -> bool:
    """Return whether one slip tells two names apart; in a short one, one that leaves its letters as they are."""
    short = len(name) <= _SHORT and len(name) == len(program)
    return is_one_slip(name, program) and not (short and sorted(name.lower()) != sorted(program.lower()))


def _programs(path: str) -> Iterator[str]:
    for folder in path.split(os.pathsep):
        try:
            yield from os.listdir(folder or os.curdir)  # noqa: PTH208 - names are all that is wanted
        except OSError:
            continue  # a PATH may name folders that are not there


def missing_file(path: str, file: str, environment: Mapping[str, str], weight: Severity) -> Missing:
    """Return what is to be said of a file that code in another one asks for.

    One that is neither in the project of that file nor where packages are is of the machine (`/etc/robot/setup.yaml`):
    it is of such a weight, unless one slip in each of its names explains it.
    """
    changes = near_names(Path.cwd() / path)
    if weight is Severity.ERROR or is_certain(changes) or not is_of_the_machine(path, file, environment):
        told = f"there is no file {displayed(path)}, which the code asks for"
        return Missing(Severity.ERROR, told, rewritten(path, changes) if changes else None)
    return Missing(weight, f"there is no file {displayed(path)} {HERE}", None)


def is_another(package: str, packages: Packages, file: str | None) -> bool:
    """Return whether an importable package is not what has the executables of the package of that name.

    It may only share the name: a workspace may have a package `bringup` or `serial`, and the interpreter a module of
    that name. Or it is the source of a package that nobody has built, which a launch file imports from.
    """
    share = packages.share(package)
    if share is None or file is None or Path(share).parent.name == "share":
        return False  # what ament has installed is the package itself
    here = Path(share).absolute()
    if not packages.executables(package) and any(_is_of(package, place) for place in (here, here.parent)):
        return True
    for folder in Path(file).absolute().parents:
        if folder == here:
            return False
        manifest = folder / "package.xml"
        if is_file(manifest):
            return _is_of(package, folder)
        if folder.name == package:
            return not is_file(folder / "__init__.py")
    return False


def _is_of(package: str, folder: Path) -> bool:
    """Return whether a folder holds the source of a package."""
    manifest = folder / "package.xml"
    return is_file(manifest) and f"<name>{package}</name>" in manifest.read_text("utf-8", "replace")


def is_certain(changes: Sequence[tuple[str, str]]) -> bool:
    """Return whether one slip in each of the names of a path explains it, given the names that were meant."""
    return bool(changes) and all(is_one_slip(name, near) for name, near in changes)


def is_of_the_machine(path: str, file: str, environment: Mapping[str, str]) -> bool:
    """Return whether a path leads out of the folder of a file, the one around it, and those where packages are.

    So does one that begins in the working directory, as `config/robot.yaml`, where it is there from a folder above: who
    launches the file from that one finds it.
    """
    prefixes = environment.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    folder = os.path.dirname(os.path.abspath(file))  # noqa: PTH100, PTH120 - names are all that is wanted
    around = os.path.dirname(folder)  # noqa: PTH120 - as above
    if not Path(path).is_absolute():
        return any(is_file(above / path) for above in Path(folder).parents)
    ours = [folder, *(prefix for prefix in (around, sys.prefix, *prefixes) if prefix not in ("", "/"))]
    whole = Path(os.path.normpath(path))
    return not any(place.is_relative_to(where) for where in ours for place in (Path(path), whole))
