"""Nodes without a package: programs of the search path, or executables of a package that was forgotten."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.location import is_python
from orchestra.resolve.context import POISON
from orchestra.resolve.programs import SHORTEST, program_words
from orchestra.resolve.runnable import program_on_path

if TYPE_CHECKING:
    from orchestra.description.actions.node import Node
    from orchestra.resolve.context import Poison, Value
    from orchestra.resolve.resolution import Resolution


def unpackaged_words(executable: Value, action: Node, run: Resolution) -> tuple[str, ...] | Poison:
    """Return the words that start a node without a package.

    A program that the search path lacks and a package has is one whose package is missing. One that nobody has may be
    on the machine that it is started on: in XML and YAML, where hardly any node is without a package, it is a warning.
    """
    name, code = executable.text, is_python(action.span)
    if not executable.verbatim or action.faulty or action.faults or _is_on_path(name, run):
        return program_words(name, executable.location, run)
    key = "package" if code else "pkg"
    told = f"'{key}' is missing: there is no program '{name}' on the search path"
    owners = _owners(name, run)
    if owners:
        notes = (f"it is an executable of {', '.join(map(repr, owners))}",)
        run.problems.error(Code.MISSING_KEY, told, run.at(action.span), notes=notes)
        return POISON
    if code or len(name) < SHORTEST:
        return program_words(name, executable.location, run)
    run.problems.warning(Code.MISSING_EXECUTABLE, told, run.at(action.span))
    return (name,)


def _is_on_path(name: str, run: Resolution) -> bool:
    """Return whether a program is found, or may be: where it is a path, or the search path is another one then."""
    if os.sep in name or "PATH" in run.scope.changes:
        return True
    return program_on_path(name, run.scope.environment) is not None


def _owners(name: str, run: Resolution) -> tuple[str, ...]:
    packages = run.context.packages
    return tuple(package for package in packages.names() if packages.executable(package, name) is not None)
