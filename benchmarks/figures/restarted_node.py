"""A Python node that is killed, until it runs again; without a delay."""

from __future__ import annotations

import os
import signal
import time
from typing import TYPE_CHECKING

from benchmarks import launching, node_package
from benchmarks.figure import Figure, Sample, Site
from benchmarks.signs import Signs

if TYPE_CHECKING:
    from collections.abc import Mapping

FIGURES = (
    Figure("restarted-node", "killed Python node running again", "its cold start", "ratio", 0.3, "s", 1, (1,), 1),
)  # fmt: skip


def measure(site: Site, size: int) -> Mapping[str, Sample]:
    """Measure it; `size` is the number of nodes, of which the first is killed."""
    file = node_package.write(site.folder, size, ", restart: {policy: always, delay: 0.0, min_uptime: 0.0}")
    with Signs(site.folder / "signs") as signs:
        signalling = Site(site.folder, launching.with_variables(site.environment, BENCHMARK_SIGNS=signs.path))
        began = time.perf_counter()
        with launching.started(node_package.by_hand(0), signalling) as popen:
            floor = signs.wait(1, popen) - began
            popen.send_signal(signal.SIGINT)
        with launching.started(launching.orchestra("launch", file), signalling) as popen:
            signs.wait(1 + size, popen)
            began = time.perf_counter()
            os.kill(int(signs.lines[1]), signal.SIGKILL)
            ours = signs.wait(2 + size, popen) - began
            popen.send_signal(signal.SIGINT)
    return {"restarted-node": Sample(ours, floor)}
