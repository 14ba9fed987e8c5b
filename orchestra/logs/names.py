"""What processes are called on the screen and on disk."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Iterable

_UNFIT = pattern(r"[^\w.#@+-]+")
_LONGEST_STEM = 120
# A longer name stands out instead of moving every other line to the right.
_WIDEST = 32


def shown(process: str) -> str:
    """Return the id of a process as people read it: without the first slash."""
    return process.removeprefix("/") or process


def log_stems(processes: Iterable[str]) -> dict[str, str]:
    """Return a file name for each process, without extension: its id with dots for slashes, each one once."""
    stems: dict[str, str] = {}
    taken = {"all"}
    for process in processes:
        stem = _UNFIT.sub("_", shown(process).replace("/", "."))[:_LONGEST_STEM].lstrip(".") or "process"
        unique, count = stem, 1
        while unique in taken:
            count += 1
            unique = f"{stem}~{count}"
        taken.add(unique)
        stems[process] = unique
    return stems


def prefixes(processes: Iterable[str]) -> dict[str, str]:
    """Return `[name] ` for each process, padded so that what follows is aligned."""
    names = {process: shown(process) for process in processes}
    width = min(_WIDEST, max(map(len, names.values()), default=0))
    return {process: f"[{name}]".ljust(width + 2) + " " for process, name in names.items()}
