"""From the command to the first process: YAML with one executable, the first time and unchanged."""

from __future__ import annotations

import shutil
import subprocess
import sys
import time
from typing import TYPE_CHECKING

from benchmarks import launching
from benchmarks.figure import Figure, Sample
from benchmarks.signs import Signs

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from benchmarks.figure import Site

_FLOOR = "an interpreter that spawns one process"
FIGURES = (
    Figure("first-process", "command to first process, first time", _FLOOR, "ratio", 5.0, "s", 1, (1, 10, 100), 1),
    Figure("unchanged", "command to first process, unchanged", _FLOOR, "ratio", 3.0, "s", 1, (1, 10, 100), 1),
)  # fmt: skip
_SPAWN = "import subprocess, sys; subprocess.run(sys.argv[1:], check=True)"


def measure(site: Site, size: int) -> Mapping[str, Sample]:
    """Measure it with so many executables in the file, all of which say that they run."""
    with Signs(site.folder / "signs") as signs:
        words = ["/bin/sh", "-c", f"echo up > {signs.path}"]
        file = site.folder / "one.launch.yaml"
        entry = f"  - executable: {{cmd: /bin/sh -c 'echo up > {signs.path}'}}\n"
        file.write_text("launch:\n" + entry * size)
        floor = _first(signs, [sys.executable, "-c", _SPAWN, *words], site, 1)
        command = launching.orchestra("launch", file)
        first = _first(signs, command, site, size)
        again = _first(signs, command, site, size)
        other = launching.upstream(file)
        peer = _first(signs, other, site, size) if other else None
    shutil.rmtree(site.folder / "home", ignore_errors=True)
    return {"first-process": Sample(first, floor, peer), "unchanged": Sample(again, floor, peer)}


def _first(signs: Signs, command: Sequence[str], site: Site, size: int) -> float:
    """Return the seconds to the first sign; all of them are waited for."""
    before = len(signs.lines)
    began = time.perf_counter()
    with launching.started(command, site, subprocess.DEVNULL) as popen:
        came = signs.wait(before + 1, popen)
        signs.wait(before + size, popen)
        launching.finished(popen)
    return came - began
