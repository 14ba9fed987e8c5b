"""Which processes a client means, by names and patterns.

`/robot1/ekf` or `robot1/ekf` is the process of this id, `/robot1/` or `robot1/*` is everything in a namespace and in
those below it; `*ekf*` and `robot[12]/ekf` are glob patterns (fnmatch(3)), in which `*` fits slashes too.
"""

from __future__ import annotations

from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

from orchestra.logs.names import shown

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

_WILD = frozenset("*?[")


class UnmatchedError(ValueError):
    """No process fits a pattern; `meant` is the name that it is most like, if there is one."""

    def __init__(self, pattern: str, meant: str | None) -> None:
        hint = f"; did you mean '{meant}'?" if meant else ""
        what = "fits" if _WILD.intersection(pattern) or pattern.endswith("/") else "is called"
        super().__init__(f"no process {what} '{pattern}'{hint}")
        self.meant = meant


def select(patterns: Iterable[str], processes: Sequence[str]) -> list[str]:
    """Return the ids that are meant, in the order of the plan. Raises `UnmatchedError` for a pattern in vain."""
    meant: set[str] = set()
    for pattern in patterns:
        found = _fitting(pattern, processes)
        if not found:
            raise UnmatchedError(pattern, _nearest(pattern, processes))
        meant.update(found)
    return [process for process in processes if process in meant]


def _fitting(pattern: str, processes: Sequence[str]) -> list[str]:
    """Find an id, else a name, else what fits a pattern: a name may have the signs of one."""
    if pattern in processes:
        return [pattern]
    name = shown(pattern)
    named = [process for process in processes if name == shown(process)]
    if named:
        return named
    if pattern.endswith("/"):
        return [process for process in processes if shown(process).startswith(name) or name == "/"]
    return [process for process in processes if fnmatchcase(shown(process), name)]


def _nearest(pattern: str, processes: Sequence[str]) -> str | None:
    from orchestra.nearest import nearest  # noqa: PLC0415 - difflib is slow to import, and most names are right

    folders = {f"{shown(process).rpartition('/')[0]}/" for process in processes if "/" in shown(process)}
    return nearest(shown(pattern), folders if pattern.endswith("/") else map(shown, processes))
