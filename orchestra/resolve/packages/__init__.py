"""Where packages are on this machine: the ament index first, then Python packages by their importable name.

A Python package (the bringup, editable or from a wheel) needs no ament: its share folder is the package folder, or the
folder with `package.xml` around it where it is the source of an ament package (`pip install -e`); its
prefix is the interpreter's where it is installed below that, else the folder that holds it. An executable is, in
this order, ament's `lib/PKG/EXE`, a console script `EXE` that starts something in PKG or comes with the distribution
of that name, the module `PKG.nodes.EXE`. Nothing is imported to find it.
"""

from __future__ import annotations

import os
import sys
from functools import cache
from typing import TYPE_CHECKING

from orchestra.resolve.packages import ament, python, scripts
from orchestra.witness.once import once

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from orchestra.resolve.model import Resolved, ResolvedProcess

__all__ = ["InstalledPackages", "has_manifests", "manifest_beside", "manifest_of", "may_need_definitions"]

_MANIFEST = "package.xml"


class InstalledPackages:
    """The packages that an environment shows; implements `orchestra.resolve.context.Packages`.

    What is found is kept: a package that is installed later is seen by a new instance only.
    """

    def __init__(self, environment: Mapping[str, str]) -> None:
        self._prefixes = ament.prefixes(environment)
        self._ament = cache(self._look_in_ament)
        self._python = cache(python.folder)
        self._scripts = cache(scripts.declared_scripts)
        self._executables = cache(ament.executables)
        self._nodes = cache(python.nodes)
        self._prefix = cache(self._find_prefix)
        self._share = cache(self._find_share)
        self._command = cache(self._find_command)
        self._names = cache(self._find_names)

    def prefix(self, package: str) -> str | None:
        """Return the install prefix, None for an unknown package."""
        return self._prefix(package)

    def share(self, package: str) -> str | None:
        """Return the share folder, None for an unknown package."""
        return self._share(package)

    def _find_prefix(self, package: str) -> str | None:
        if (prefix := self._ament(package)) is not None:
            return str(prefix)
        folder = self._python(package)
        if folder is None:
            return None
        return sys.prefix if folder.is_relative_to(sys.prefix) else str(folder.parent)

    def _find_share(self, package: str) -> str | None:
        if (prefix := self._ament(package)) is not None:
            return str(prefix / "share" / package)
        folder = self._python(package)
        return None if folder is None else str(python.source(folder) or folder)

    def executable(self, package: str, executable: str) -> tuple[str, ...] | None:
        """Return the words of the command that starts it, None where the package has no such executable."""
        return self._command(package, executable)

    def names(self) -> tuple[str, ...]:
        """Return all packages of the ament index, Python packages with nodes, sources of ament's, for suggestions."""
        return self._names()

    def executables(self, package: str) -> tuple[str, ...]:
        """Return the names of the package's executables, for suggestions."""
        prefix, folder = self._ament(package), self._python(package)
        found = set() if prefix is None else set(self._executables(prefix, package))
        if folder is not None:
            found.update(self._nodes(folder))
            scripts_here = {script.name for script in self._scripts() if package in script.owners}
            found.update(name for name in scripts_here if self._script(package, name) is not None)
        return tuple(sorted(found))

    def _find_command(self, package: str, executable: str) -> tuple[str, ...] | None:
        prefix = self._ament(package)
        if prefix is not None and (path := self._executables(prefix, package).get(executable)):
            return (str(path),)
        folder = self._python(package)
        if folder is None:
            return None
        if path := self._script(package, executable):
            return (str(path),)
        if executable in self._nodes(folder):
            return (sys.executable, "-m", f"{package}.nodes.{executable}")
        return None

    def _script(self, package: str, name: str) -> Path | None:
        return scripts.script_file(package, name, self._scripts())

    def _find_names(self) -> tuple[str, ...]:
        indexed = (name for prefix in self._prefixes for name in ament.packages(prefix))
        owners = {script.owners[0] for script in self._scripts()}
        sources = (name for name in owners if (folder := self._python(name)) and python.source(folder))
        return tuple(sorted({*indexed, *python.packages_with_nodes(), *sources}))

    def _look_in_ament(self, package: str) -> Path | None:
        return next((prefix for prefix in self._prefixes if ament.has(prefix, package)), None)


def has_manifests(resolved: Resolved) -> bool:
    """Tell whether a node or component is of a package that says in a file what it needs, and not of ament's."""
    nodes = [process for process in resolved.processes if process.kind != "process"]
    shares = {node.share for node in nodes} | {component.share for component in resolved.components}
    return any(share is not None and manifest_beside(share) is not None for share in shares) or any(
        node.share is None and may_need_definitions(node) for node in nodes
    )


def may_need_definitions(process: ResolvedProcess) -> bool:
    """Tell whether a process is a node of such a package."""
    return process.kind != "process" and manifest_of(process) is not None


def manifest_of(process: ResolvedProcess) -> str | None:
    """Return the `package.xml` of the Python package or script of a process, None where it has none."""
    if process.share is not None:
        return manifest_beside(process.share)
    if process.kind == "process" or process.package is not None:
        return None
    script = next((word for word in process.program if word.endswith(".py")), None)
    return _first(_above(os.path.abspath(script))) if script else None  # noqa: PTH100 - pathlib is slow


def manifest_beside(share: str) -> str | None:
    """Return the `package.xml` of the package with this share folder, None where ament has installed it."""
    if not share.startswith("/"):  # another working folder makes another one of it
        return _beside(share)
    return once(("manifest", share), lambda: _beside(share))


def _beside(share: str) -> str | None:
    above = os.path.dirname(share)  # noqa: PTH120 - pathlib is slow
    return None if os.path.basename(above) == "share" else _first([share, above])  # noqa: PTH119 - as above


def _above(path: str) -> list[str]:
    found = []
    while (above := os.path.dirname(path)) != path:  # noqa: PTH120 - as above
        found.append(above)
        path = above
    return found


def _first(folders: list[str]) -> str | None:
    paths = (os.path.join(folder, _MANIFEST) for folder in folders)  # noqa: PTH118 - as above
    return next((path for path in paths if os.path.isfile(path)), None)  # noqa: PTH113 - as above
