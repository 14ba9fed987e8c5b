"""Programs by name: executables of packages, files beside the launch file, what the search path has."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.errors import Code, Severity
from orchestra.location import displayed, is_python
from orchestra.resolve.containers import own_words
from orchestra.resolve.context import POISON, Packaged
from orchestra.resolve.near_paths import near_path
from orchestra.resolve.paths import beside, folder_of, settled_path
from orchestra.resolve.refusals import refuse_value, report_missing_executable, report_missing_package
from orchestra.resolve.runnable import fault_of, program_on_path, programs_on_path
from orchestra.resolve.typos import is_typo
from orchestra.witness.once import once

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.description.text import Template
    from orchestra.location import Location
    from orchestra.resolve.context import Poison, Value
    from orchestra.resolve.resolution import Resolution
    from orchestra.resolve.runnable import Fault

# Names of programs are short, and there are many: of these nothing can be told.
SHORTEST = 5


def program_words(
    written: str, location: Location, run: Resolution, *, elsewhere: bool = False
) -> tuple[str, ...] | Poison:
    """Return the words that start a program given by name or path.

    A bare name is looked up when the process starts. A relative path is one below the working directory or beside
    the launch file; one that is neither is reported, unless the process runs `elsewhere` and may find it there. What
    is there and cannot be started is reported too.
    """
    if os.sep not in written:
        _check_name(written, location, run)
        return (written,)
    if os.path.isabs(written):  # noqa: PTH117 - pathlib is slow
        found = written
    else:
        near = folder_of(run.context.file) / written
        found = beside(run.context.file, written) or (str(near) if near.is_dir() else "")
        if not found and not elsewhere:
            message, suggestion = f"there is no executable {displayed(str(near))}", near_path(near, written)
            run.problems.error(Code.MISSING_EXECUTABLE, message, location, suggestion=suggestion)
            return POISON
    return (found or written,) if _is_runnable(found, location, run) else POISON


def is_missing(program: Value, run: Resolution) -> bool:
    """Report a program that is not there and should be: beside the launch file, or in a package."""
    at = program.location
    if os.path.exists(program.text) or run.later or is_python(at):  # noqa: PTH110 - pathlib is slow
        return False
    missing = settled_path(program, run)
    if missing is not None:
        message, raw = f"there is no executable {displayed(str(missing))}", program.raw
        meant = None if raw is None else near_path(missing, raw)
        run.problems.error(Code.MISSING_EXECUTABLE, message, at, suggestion=meant if meant != raw else None)
    return missing is not None


def packaged_words(
    package: Value, executable: Value, written: tuple[Template, Template], run: Resolution
) -> tuple[str, ...] | Poison:
    """Return the words that start an executable of a package; `written` are the texts that name the two.

    For a package that is not on this machine they name the place symbolically; whether that is an error is decided
    where it is reported.
    """
    known = (package.text, executable.text, run.scope.environment.get("PATH", os.defpath))
    found = run.packaged.get(known)
    if found is not None:
        return found.words
    packages = run.context.packages
    own = own_words(package, executable, written[0], run)
    if own is not None:
        return own
    if packages.prefix(package.text) is None:
        if package.text in packages.executables(executable.text):
            told = (
                f"{package.text!r} is an executable of the package {executable.text!r}: the two are swapped"
            )
            return refuse_value(package, run.problems, Code.MISSING_PACKAGE, told, meant=executable.text)
        return _elsewhere(package, executable, written, run)
    words = packages.executable(package.text, executable.text)
    if words is None:
        # Here, because most executables are there.
        from orchestra.resolve.lacking import is_another  # noqa: PLC0415

        if is_another(package.text, packages, run.context.file):
            return _elsewhere(package, executable, written, run)
        return report_missing_executable(executable.text, package.text, written[1], run.context, executable)
    if not _is_runnable(words[0], executable.location, run):
        return POISON
    if (words[0], known[2]) in run.startable:  # there is nothing to tell of it
        run.packaged[known] = Packaged(package.text, executable.text, words, packages.share(package.text))
    return words


def _elsewhere(
    package: Value, executable: Value, written: tuple[Template, Template], run: Resolution
) -> tuple[str, ...]:
    """Report a package that is not here, and return the symbolic name of its executable."""
    report_missing_package(package.text, written[0], run.context, package)
    return ("${prefix:" + package.text + "}/lib/" + f"{package.text}/{executable.text}",)


def _is_runnable(path: str, location: Location, run: Resolution) -> bool:
    """Return whether a file can be started; what is there and cannot be is reported.

    What is wrong with a file of others is a warning where nothing is started.
    """
    environment = run.scope.environment
    search = environment.get("PATH", os.defpath)
    if (path, search) in run.startable:
        return True
    told, fault = once(("program", path, search), lambda: _seen(path, environment))
    if told:
        certain = run.inputs.launching or Path(path).is_relative_to(folder_of(run.context.file))
        report = run.problems.error if certain else run.problems.warning
        report(Code.MISSING_EXECUTABLE, f"{displayed(path)} is {told}", location)
        return not certain
    if fault is None:
        run.startable.add((path, search))
        return True
    message = f"{displayed(path)} cannot be started: {fault.reason}"
    weight = run.inputs.weights.package if fault.here else Severity.ERROR
    run.problems.weighed(weight, Code.MISSING_EXECUTABLE, message, location, notes=fault.notes)
    return weight is not Severity.ERROR


def _seen(path: str, environment: Mapping[str, str]) -> tuple[str, Fault | None]:
    """Return what a path is that can never be started, and why the file there cannot be."""
    if not os.path.exists(path):  # noqa: PTH110 - pathlib raises for some paths
        return "", None  # it may be made by then, or be on the machine that is started on
    if os.path.isdir(path):  # noqa: PTH112 - as above
        return "a folder", None
    return ("", fault_of(path, environment)) if os.access(path, os.X_OK) else ("not executable", None)


def _check_name(name: str, location: Location, run: Resolution) -> None:
    """Report a program that the search path lacks where it has a near one: any other may be there when it starts."""
    environment = run.scope.environment
    first, blank, _ = name.partition(" ")
    if (
        blank
        and program_on_path(name, environment) is None
        and program_on_path(first, environment) is not None
    ):
        message = f"there is no program '{name}': its words are to stand apart from one another"
        run.problems.warning(Code.MISSING_EXECUTABLE, message, location)
        return
    if len(name) < SHORTEST or "PATH" in run.scope.changes or program_on_path(name, environment) is not None:
        return
    meant = sorted(
        known for known in programs_on_path(environment) if known[:1] == name[:1] and is_typo(name, known)
    )
    if meant:
        message = f"there is no program '{name}' on the search path"
        run.problems.warning(Code.MISSING_EXECUTABLE, message, location, suggestion=meant[0])
