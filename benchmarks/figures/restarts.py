"""Memory of keeper and supervisor after many restarts, beside that after a hundredth of them."""

from __future__ import annotations

import signal
from typing import TYPE_CHECKING

from benchmarks import costs, launching
from benchmarks.figure import Figure, Sample
from benchmarks.signs import Signs

if TYPE_CHECKING:
    from collections.abc import Mapping

    from benchmarks.figure import Site

FIGURES = (
    Figure(
        "restarts", "memory (PSS) of our processes after 10,000 restarts", "after 100 restarts",
        "difference", 1.0, "MiB", 10_000, (1_000, 10_000), 100, rounds=1,
    ),
)  # fmt: skip


def measure(site: Site, size: int) -> Mapping[str, Sample]:
    """Measure it with so many restarts of one process."""
    with Signs(site.folder / "signs") as signs:
        restart = "{policy: always, delay: 0.0, min_uptime: 0.0}"
        file = site.folder / "again.launch.yaml"
        script = f"echo up > {signs.path}"
        file.write_text(f"launch:\n  - executable: {{cmd: /bin/sh -c '{script}', restart: {restart}}}\n")
        with launching.started(launching.orchestra("launch", file), site) as popen:
            signs.wait(max(2, size // 100), popen)
            before = _memory(popen.pid)
            signs.wait(size, popen)
            after = _memory(popen.pid)
            popen.send_signal(signal.SIGINT)
    return {"restarts": Sample(after, before)}


def _memory(root: int) -> float:
    ours = (process.pid for process in costs.tree(root) if process.name.startswith("orc-"))
    return sum(map(costs.memory, ours))
