"""Packages that are asked for by many files: each question is answered once, and recorded with its answer."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Any, Final

from orchestra.resolve.packages import InstalledPackages
from orchestra.resolve.packages.extensions import extends
from orchestra.resolve.packages.python import libraries
from orchestra.witness.observing import observer

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

PACKAGES: Final = "packages"


class RecordedPackages(InstalledPackages):
    """Packages that are looked up once for all files; what is asked for is recorded as questions with answers."""

    def __init__(self, environment: Mapping[str, str]) -> None:
        super().__init__(environment)
        self._environment = dict(environment)
        self._path = self._usual = (*sys.path, *libraries(environment))
        self._known: dict[tuple[str, ...], Any] = {}

    def prefix(self, package: str) -> str | None:
        """Return the install prefix, None for an unknown package."""
        found: str | None = self._ask("prefix", package)
        return found

    def share(self, package: str) -> str | None:
        """Return the share folder, None for an unknown package."""
        found: str | None = self._ask("share", package)
        return found

    def executable(self, package: str, executable: str) -> tuple[str, ...] | None:
        """Return the words of the command that starts it, None where the package has no such executable."""
        found: list[str] | None = self._ask("executable", package, executable)
        return None if found is None else tuple(found)

    def names(self) -> tuple[str, ...]:
        """Return the names of all packages, for suggestions."""
        return tuple(self._ask("names"))

    def executables(self, package: str) -> tuple[str, ...]:
        """Return the names of the package's executables, for suggestions."""
        return tuple(self._ask("executables", package))

    def answer(self, words: Sequence[str]) -> Any:  # noqa: ANN401 - JSON data
        """Answer the question for a method and its arguments."""
        path = tuple(sys.path)
        if path != self._path:  # code of a launch file has changed it, or what it had changed was put back
            super().__init__(self._environment)
            self._path, self._known = path, {}
        key = tuple(words)
        if key not in self._known:
            found = _METHODS[words[0]](self, *words[1:])
            self._known[key] = list(found) if isinstance(found, tuple) else found
        return self._known[key]

    def _ask(self, *words: str) -> Any:  # noqa: ANN401 - JSON data
        if tuple(sys.path) != self._usual:
            observer().unknown("code has changed where Python looks for packages")
        return observer().answered((PACKAGES, *words), lambda: self.answer(words))


# By what they are called; those of the class above itself are the ones that ask.
_METHODS: Final[dict[str, Callable[..., Any]]] = {
    "prefix": InstalledPackages.prefix,
    "share": InstalledPackages.share,
    "executable": InstalledPackages.executable,
    "names": InstalledPackages.names,
    "executables": InstalledPackages.executables,
}


class Questions:
    """Answers what records have answers to, as things are now; a question that is not known has no answer."""

    def __init__(self, environment: Mapping[str, str]) -> None:
        self._packages = RecordedPackages(environment)
        self._libraries = libraries(environment)

    def answer(self, question: str) -> Any:  # noqa: ANN401 - JSON data
        """Return the answer to the words of a question, where launch files are loaded."""
        kind, *words = json.loads(question)
        before = list(sys.path)
        sys.path += self._libraries
        try:
            return self._packages.answer(words) if kind == PACKAGES else _OTHERS[kind](*words)
        finally:
            sys.path[:] = before


_OTHERS: Final[dict[str, Callable[..., Any]]] = {"extends": extends}
