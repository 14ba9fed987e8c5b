"""Programs by name: executables of packages, files beside the launch file, what the search path has."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.location import displayed
from orchestra.resolve.context import POISON
from orchestra.resolve.refusals import report_missing_executable, report_missing_package

if TYPE_CHECKING:
    from orchestra.description.actions.node import Node
    from orchestra.location import Location
    from orchestra.resolve.context import Poison, Value
    from orchestra.resolve.resolution import Resolution


def program_words(written: str, location: Location, run: Resolution) -> tuple[str, ...] | Poison:
    """Return the words that start a program given by name or path.

    A bare name is looked up when the process starts. A relative path is one below the working directory or beside
    the launch file; one that is neither is reported.
    """
    path = Path(written)
    if len(path.parts) <= 1 or path.is_absolute() or path.exists():
        return (written,)
    folder = Path(run.context.file).parent if run.context.file else Path.cwd()
    if (folder / path).exists():
        return (os.path.normpath(folder / path),)
    message = f"there is no executable {displayed(str(folder / path))}"
    run.problems.error(Code.MISSING_EXECUTABLE, message, location)
    return POISON


def packaged_words(
    package: Value, executable: Value, action: Node, run: Resolution
) -> tuple[str, ...] | Poison:
    """Return the words that start an executable of a package.

    For a package that is not on this machine they name the place symbolically; whether that is an error is decided
    where it is reported.
    """
    packages = run.context.packages
    if packages.prefix(package.text) is None:
        report_missing_package(package.text, action.pkg or action.exec, run.context)
        return ("${prefix:" + package.text + "}/lib/" + f"{package.text}/{executable.text}",)
    words = packages.executable(package.text, executable.text)
    if words is not None:
        return words
    return report_missing_executable(executable.text, package.text, action.exec, run.context)
