"""Many processes that end at once, from the first start to the last end."""

from __future__ import annotations

from typing import TYPE_CHECKING

from benchmarks import launching
from benchmarks.figure import Figure, Sample

if TYPE_CHECKING:
    from collections.abc import Mapping

    from benchmarks.figure import Site

FIGURES = (
    Figure(
        "short-processes", "1,000 short processes, started to all ended", "a shell loop with `&`",
        "ratio", 2.0, "s", 1000, (100, 300, 1000), 5,
    ),
)  # fmt: skip


def measure(site: Site, size: int) -> Mapping[str, Sample]:
    """Measure it with so many processes; for upstream the whole command is measured, which tells nothing else."""
    file = site.folder / "short.launch.yaml"
    file.write_text("launch:\n" + "  - executable: {cmd: /bin/true}\n" * size)
    loop = f"i=0; while [ $i -lt {size} ]; do /bin/true & i=$((i+1)); done; wait"
    floor = launching.wall(["/bin/sh", "-c", loop], site)
    launching.wall(launching.orchestra("launch", file), site)
    starts, ends = (launching.moments(site, kind) for kind in ("process_starting", "process_exited"))
    if len(ends) != size:
        raise RuntimeError(f"{len(ends)} of {size} processes ended as they should")
    other = launching.upstream(file)
    return {
        "short-processes": Sample(
            max(ends) - min(starts), floor, launching.wall(other, site) if other else None
        )
    }
