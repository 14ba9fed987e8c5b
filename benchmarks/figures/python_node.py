"""One Python node by `node`, until its first message."""

from __future__ import annotations

import signal
import time
from typing import TYPE_CHECKING

from benchmarks import launching, node_package
from benchmarks.figure import Figure, Sample, Site
from benchmarks.signs import Signs

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

FIGURES = (
    Figure(
        "python-node", "one Python node, until its first message", "the same node started by hand",
        "ratio", 1.6, "s", 1, (1,), 1,
    ),
)  # fmt: skip


def measure(site: Site, size: int) -> Mapping[str, Sample]:
    """Measure it; `size` is the number of nodes, of which the first message counts."""
    file = node_package.write(site.folder, size)
    with Signs(site.folder / "signs") as signs:
        signalling = Site(site.folder, launching.with_variables(site.environment, BENCHMARK_SIGNS=signs.path))
        floor = _first_message(signs, node_package.by_hand(0), signalling)
        ours = _first_message(signs, launching.orchestra("launch", file), signalling)
        other = launching.upstream(file)
        peer = _first_message(signs, other, signalling) if other else None
    return {"python-node": Sample(ours, floor, peer)}


def _first_message(signs: Signs, command: Sequence[str], site: Site) -> float:
    before = len(signs.lines)
    began = time.perf_counter()
    with launching.started(command, site) as popen:
        came = signs.wait(before + 1, popen)
        popen.send_signal(signal.SIGINT)
    return came - began
