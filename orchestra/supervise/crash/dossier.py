"""The dossier of one abnormal end, as data: what the files in its folder are made of."""

from __future__ import annotations

import itertools
import shlex
from typing import TYPE_CHECKING, Any

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.supervise.keeping.marks import PROCESS, RUN

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

VERSION = 1


@dataclass(frozen=True, slots=True)
class Run:
    """One run of a process: which start it was, when it began (seconds since the epoch), how long it took, its end."""

    start: int
    began: float
    uptime: float
    ending: str


@dataclass(frozen=True, slots=True)
class Cause:
    """Why it ended: `ending` as everywhere, `meaning` in words, `evidence` what it or the kernel said of it."""

    ending: str
    meaning: str
    code: int | None
    signal: str | None
    reason: str | None
    hang: str | None
    core_dumped: bool
    out_of_memory: str | None
    evidence: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Difference:
    """How the environment of a process differs from that of the launcher."""

    added: dict[str, str]
    changed: dict[str, tuple[str, str]]
    removed: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Resources:
    """What it used: bytes and seconds; None where nobody knows.

    `peak_memory` is that of the largest process, `at_most` where it cannot be told from what it had before its program
    began; `capped_peak` is that of all of it together, where it has a memory cap.
    """

    peak_memory: int | None
    at_most: bool
    capped_peak: int | None
    user_time: float | None
    system_time: float | None


@dataclass(frozen=True, slots=True)
class Dossier:
    """Everything that is known about one abnormal end.

    `command` is what was executed, `repeat` what does the same in a shell, in the launcher's environment.
    `limits` are those of the plan, `rlimits` what was in force (soft and hard), `threads` where a hung process was.
    """

    process: str
    run: str
    location: str
    ended: float
    uptime: float
    start: int
    pid: int | None
    cause: Cause
    lines: tuple[str, ...]
    log: str
    history: tuple[Run, ...]
    runs_before: int
    command: tuple[str, ...]
    cwd: str
    repeat: str
    parameter_files: tuple[str, ...]
    environment: Difference
    core: str | None
    core_advice: str | None
    resources: Resources
    limits: dict[str, Any] | None
    rlimits: dict[str, tuple[int, int]] = field(default_factory=dict)
    threads: tuple[str, ...] = ()


def as_document(dossier: Dossier) -> dict[str, Any]:
    """Return the dossier as JSON data."""
    from dataclasses import asdict  # noqa: PLC0415 - every run needs this module, few a document

    return {"version": VERSION, **asdict(dossier)}


def difference(launcher: Mapping[str, str], process: Mapping[str, str]) -> Difference:
    """Return how an environment differs from the launcher's; the marks of the run are ours and do not count."""
    ours = {RUN, PROCESS}
    before = {name: value for name, value in launcher.items() if name not in ours}
    now = {name: value for name, value in process.items() if name not in ours}
    return Difference(
        added={name: now[name] for name in sorted(now.keys() - before.keys())},
        changed={
            name: (before[name], now[name])
            for name in sorted(now.keys() & before.keys())
            if now[name] != before[name]
        },
        removed=tuple(sorted(before.keys() - now.keys())),
    )


def repetition(command: Sequence[str], cwd: str, changes: Difference) -> str:
    """Return lines for a POSIX shell that run a command again, from the launcher's environment and as it was run."""
    wanted = {**changes.added, **{name: now for name, (_, now) in changes.changed.items()}}
    # Names that are no variables for a shell are left to env, which takes any.
    words = [
        *(f"-u {shlex.quote(name)}" for name in changes.removed),
        *(shlex.quote(f"{name}={value}") for name, value in sorted(wanted.items())),
    ]
    lines = [f"cd {shlex.quote(cwd)} && env", *words, shlex.join(command)]
    return " \\\n    ".join(lines)


def parameter_files(command: Sequence[str]) -> tuple[str, ...]:
    """Return the parameter files that a command names."""
    return tuple(file for word, file in itertools.pairwise(command) if word == "--params-file")
