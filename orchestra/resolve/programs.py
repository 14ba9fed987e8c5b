"""Programs by name: executables of packages, files beside the launch file, what the search path has."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.location import displayed
from orchestra.resolve.context import POISON
from orchestra.resolve.paths import beside, folder_of, near_path
from orchestra.resolve.refusals import report_missing_executable, report_missing_package

if TYPE_CHECKING:
    from orchestra.description.actions.node import Node
    from orchestra.location import Location
    from orchestra.resolve.context import Poison, Value
    from orchestra.resolve.resolution import Resolution


def program_words(
    written: str, location: Location, run: Resolution, *, elsewhere: bool = False
) -> tuple[str, ...] | Poison:
    """Return the words that start a program given by name or path.

    A bare name is looked up when the process starts. A relative path is one below the working directory or beside
    the launch file; one that is neither is reported, unless the process runs `elsewhere` and may find it there.
    """
    path = Path(written)
    if os.sep not in written or path.is_absolute():
        return (written,)
    found = beside(run.context.file, written)
    if found is None:
        if elsewhere:
            return (written,)
        near = folder_of(run.context.file) / path
        message, suggestion = f"there is no executable {displayed(str(near))}", near_path(near, written)
        run.problems.error(Code.MISSING_EXECUTABLE, message, location, suggestion=suggestion)
        return POISON
    if not os.access(found, os.X_OK):
        run.problems.error(Code.MISSING_EXECUTABLE, f"{displayed(found)} is not executable", location)
        return POISON
    return (found,)


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
