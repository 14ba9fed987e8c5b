"""`orchestra check` on a tree of launch files, without a cache, against the time that loading them takes."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from benchmarks import launching, mixed_tree
from benchmarks.figure import Figure, Sample

if TYPE_CHECKING:
    from collections.abc import Mapping

    from benchmarks.figure import Site

_SIZES = (100, 300, 1000)
FIGURES = (
    Figure(
        "check", "check of 1,000 launch files, nothing cached", "loading them, and an interpreter's start",
        "ratio", 2.0, "s", 1000, _SIZES, 20, rounds=3,
    ),
    Figure(
        "check-again", "the same, nothing changed", "loading them, and an interpreter's start",
        "ratio", 1.0, "s", 1000, _SIZES, 20, rounds=3,
    ),
)  # fmt: skip

_LOAD = """
import sys, time
from pathlib import Path
from orchestra import pipeline
from orchestra.errors import Problems
from orchestra.load.files import load
from orchestra.resolve.packages import InstalledPackages
import os
paths = [str(path) for path in Path(sys.argv[1]).rglob("*.launch.*")]
inputs = pipeline.inputs_from((), environment=os.environ)
packages = InstalledPackages(os.environ)
problems = Problems()
began = time.perf_counter()
with pipeline._loading(paths[0], inputs, load, packages, problems):
    for path in paths:
        load(path, problems)
seconds = time.perf_counter() - began
assert not problems.errors, problems.errors[0]
print(seconds)
"""


def measure(site: Site, size: int) -> Mapping[str, Sample]:
    """Measure it with so many files."""
    folder = site.folder / "tree"
    mixed_tree.write_tree(folder, size)
    # The bar is twice the loading and once the start; so is the floor that it is held to.
    start = launching.wall([sys.executable, "-c", "import orchestra.pipeline"], site)
    floor = launching.printed(_LOAD, [folder], site) + start / 2
    first = launching.wall(launching.orchestra("check", folder), site)
    again = launching.wall(launching.orchestra("check", folder), site)
    return {"check": Sample(first, floor), "check-again": Sample(again, floor)}
