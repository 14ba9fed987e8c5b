"""Nodes without a package: programs of the search path, or executables of a package that was forgotten."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.location import is_python
from orchestra.resolve.context import POISON
from orchestra.resolve.programs import SHORTEST, program_words
from orchestra.resolve.runnable import program_on_path

if TYPE_CHECKING:
    from orchestra.description.actions.node import Node
    from orchestra.resolve.context import Poison, Value
    from orchestra.resolve.resolution import Resolution

_NOWHERE: Final = "there is no program '{}' on the search path"


def unpackaged_words(executable: Value, action: Node, run: Resolution) -> tuple[str, ...] | Poison:
    """Return the words that start a node without a package.

    A program that the search path lacks and a package has is one whose package is missing. One that nobody has may be
    on the machine that it is started on: see `warn_of_unpackaged`.
    """
    name, code = executable.text, is_python(action.span)
    if not executable.verbatim or action.faulty or action.faults or _is_on_path(name, run):
        return program_words(name, executable.location, run)
    owners = _owners(name, run)
    if owners:
        told = f"'{'package' if code else 'pkg'}' is missing: {_NOWHERE.format(name)}"
        notes = (f"it is an executable of {', '.join(map(repr, owners))}",)
        run.problems.error(Code.MISSING_KEY, told, run.at(action.span), notes=notes)
        return POISON
    before = len(run.problems)
    words = program_words(name, executable.location, run)
    if not code and len(name) >= SHORTEST and len(run.problems) == before:
        run.found.unpackaged.append((name, run.at(action.span)))
    return words


def warn_of_unpackaged(run: Resolution) -> None:
    """Warn of programs that are nowhere and stand for a node without a package, where others of the file have one."""
    if run.found.unpackaged:
        files = {process.location.span.file for process in run.found.processes if process.package is not None}
        for name, at in run.found.unpackaged:
            if at.span.file in files:
                told = f"'pkg' is missing: {_NOWHERE.format(name)}"
                run.problems.warning(Code.MISSING_EXECUTABLE, told, at)


def _is_on_path(name: str, run: Resolution) -> bool:
    """Return whether a program is found, or may be: where it is a path, or the search path is another one then."""
    if os.sep in name or "PATH" in run.scope.changes:
        return True
    return program_on_path(name, run.scope.environment) is not None


def _owners(name: str, run: Resolution) -> tuple[str, ...]:
    packages = run.context.packages
    return tuple(package for package in packages.names() if packages.executable(package, name) is not None)
