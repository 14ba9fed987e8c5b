"""Where the core file of a crashed program is, or how to get one the next time (core(5))."""

from __future__ import annotations

import os
from glob import escape, glob
from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.supervise.limits.cgroups import read

if TYPE_CHECKING:
    from collections.abc import Iterator

_PATTERN = "/proc/sys/kernel/core_pattern"
_WITH_PID = "/proc/sys/kernel/core_uses_pid"
# What cannot be known matches anything.
_ANYTHING = "*"


@dataclass(frozen=True, slots=True)
class Core:
    """`path` of a core file that is there, None otherwise; `advice` on how to read it, or to get one."""

    path: str | None
    advice: str


@dataclass(frozen=True, slots=True)
class Victim:
    """A program that a signal has ended. `limit` is its soft RLIMIT_CORE, `dumped` what the kernel says."""

    pid: int
    program: str
    cwd: str
    signal: int
    limit: int
    dumped: bool


def core_of(victim: Victim) -> Core:
    """Return what is known about the core file of a program on this machine."""
    return told(
        victim, (read(_PATTERN) or "core").rstrip("\n"), with_pid=(read(_WITH_PID) or "0").strip() != "0"
    )


def told(victim: Victim, pattern: str, *, with_pid: bool) -> Core:
    """Return what is known where core files are handled as `pattern` says."""
    if pattern.startswith("|"):
        return _piped(victim, os.path.basename(pattern[1:].split(maxsplit=1)[0]))  # noqa: PTH119 - a name, not a file
    if not pattern:
        return Core(None, f"this machine writes no core files: {_PATTERN} is empty")
    place = os.path.join(escape(victim.cwd), _expanded(victim, pattern))  # noqa: PTH118 - it may hold wildcards
    if with_pid and "%p" not in pattern:
        place += f".{victim.pid}"
    if victim.dumped:
        paths = sorted(glob(place), key=_age)  # noqa: PTH207 - an absolute pattern
        if paths:
            return Core(paths[-1], f"gdb {victim.program} {paths[-1]}")
        return Core(None, f"the kernel wrote one to {place}, but it is not there any more")
    if victim.limit == 0:
        return Core(
            None,
            "none was written, since its limit for core files is 0; `limits: {rlimits: {core: unlimited}}` at the "
            f"process, or `ulimit -c unlimited` before the start, puts the next one at {place}",
        )
    return Core(None, f"none was written to {place}: that folder may be full or closed to the program")


def _piped(victim: Victim, handler: str) -> Core:
    """Return how to ask the program to which the kernel hands core files."""
    if handler == "systemd-coredump":
        return Core(None, f"coredumpctl debug {victim.pid}    (or: coredumpctl info {victim.pid})")
    if handler == "apport":
        return Core(None, "apport has it: see /var/crash (apport-unpack gives the core file)")
    return Core(None, f"the kernel handed it to {handler} (see {_PATTERN})")


def _expanded(victim: Victim, pattern: str) -> str:
    """Fill in the specifiers of core(5); what is not known here matches anything."""
    name = os.path.basename(victim.program)  # noqa: PTH119 - a name, not a file
    known = {
        "%": "%",
        "p": str(victim.pid),
        "e": _ANYTHING,  # the name of the thread, which need not be that of the program
        "f": escape(name),
        "E": escape(victim.program.replace("/", "!")),
        "u": str(os.getuid()),
        "g": str(os.getgid()),
        "s": str(victim.signal),
        "h": escape(os.uname().nodename),
    }
    return "".join(_pieces(pattern, known))


def _pieces(pattern: str, known: dict[str, str]) -> Iterator[str]:
    letters = iter(pattern)
    for letter in letters:
        if letter != "%":
            yield escape(letter)
            continue
        specifier = next(letters, None)  # a single % at the end is dropped
        if specifier is not None:
            yield known.get(specifier, _ANYTHING)


def _age(path: str) -> float:
    try:
        return os.stat(path).st_mtime  # noqa: PTH116 - one call of many
    except OSError:
        return 0.0
