"""What processes use of the machine, with all that runs in their sessions (proc(5)); the supervisor is not asked."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass

if TYPE_CHECKING:
    from collections.abc import Iterable

# Fields of /proc/PID/stat behind the name: 6, 14, 15 and 24, counted from the state, which is field 3.
_SESSION, _USER, _SYSTEM, _RESIDENT = 3, 11, 12, 21


@dataclass(frozen=True, slots=True)
class Usage:
    """`memory` that is resident in bytes, `cpu` time in seconds since the begin."""

    memory: int
    cpu: float


def usage(leaders: Iterable[int]) -> dict[int, Usage]:
    """Return what each of these processes uses, together with all processes of the session that it leads."""
    page, tick = os.sysconf("SC_PAGE_SIZE"), os.sysconf("SC_CLK_TCK")
    pages = dict.fromkeys(leaders, 0)
    ticks = dict.fromkeys(pages, 0)
    seen = set()
    for facts in map(_facts, Path("/proc").iterdir()):
        if facts and (leader := int(facts[_SESSION])) in pages:
            seen.add(leader)
            pages[leader] += int(facts[_RESIDENT])
            ticks[leader] += int(facts[_USER]) + int(facts[_SYSTEM])
    return {leader: Usage(pages[leader] * page, ticks[leader] / tick) for leader in seen}


def _facts(process: Path) -> list[bytes] | None:
    if not process.name.isdecimal():
        return None
    try:
        return (process / "stat").read_bytes().rpartition(b")")[2].split()
    except OSError:
        return None  # it has ended meanwhile
