"""Many lines, written in blocks, through the launcher to the screen (a file) and the log file."""

from __future__ import annotations

import shlex
import sys
from typing import TYPE_CHECKING

from benchmarks import launching
from benchmarks.figure import Figure, Sample, Site
from benchmarks.signs import Signs

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

FIGURES = (
    Figure(
        "output", "200,000 lines of 100 bytes to screen and log file", "the program piped into `cat`",
        "ratio", 5.0, "s", 200_000, (20_000, 50_000, 200_000), 2_000,
    ),
)  # fmt: skip

_LINE = 100
_PREFIX = len("[noisy] ")
# Says when it begins, so that nobody's start counts.
_PROGRAM = """
import os, sys
count, signs = int(sys.argv[1]), sys.argv[2]
line = b"x" * 99 + b"\\n"
with open(signs, "w") as file:
    file.write("begins\\n")
while count > 0:
    block = line * min(count, 655)
    count -= 655
    while block:
        block = block[os.write(1, block):]
"""


def measure(site: Site, size: int) -> Mapping[str, Sample]:
    """Measure it with so many lines, from the first to where all of them are in both files."""
    program = site.folder / "noisy.py"
    program.write_text(_PROGRAM)
    with Signs(site.folder / "signs") as signs:
        words = [sys.executable, "-S", "-E", str(program), str(size), str(signs.path)]
        file = site.folder / "noisy.launch.yaml"
        file.write_text(
            f"launch:\n  - executable: {{cmd: {shlex.join(words)}, name: noisy, output: screen}}\n"
        )
        plain = size * _LINE
        floor = _passed(signs, ["/bin/sh", "-c", f"{shlex.join(words)} | cat"], site, plain)
        ours = _passed(signs, launching.orchestra("launch", file), site, plain + size * _PREFIX)
        other = launching.upstream(file)
        peer = _passed(signs, other, site, plain) if other else None
    if (launching.run_directory(site) / "logs" / "noisy.log").stat().st_size != plain:
        raise RuntimeError("the log file has not got all")
    return {"output": Sample(ours, floor, peer)}


def _passed(signs: Signs, command: Sequence[str], site: Site, expected: int) -> float:
    """Return the seconds from the first line until the screen, and our log file, have them all."""
    screen = site.folder / "screen"
    with screen.open("wb") as file, launching.started(command, site, file.fileno()) as popen:
        began = signs.wait(len(signs.lines) + 1, popen)
        ours = "orchestra" in command
        log = launching.run_directory(site) / "logs" / "noisy.log" if ours else screen
        least = expected - expected // (_LINE + _PREFIX) * _PREFIX if ours else expected
        came = launching.until(lambda: _size(screen) >= expected and _size(log) >= least)
        launching.finished(popen)
    return came - began


def _size(path: Path) -> int:
    try:
        return path.stat().st_size
    except FileNotFoundError:
        return 0
