"""Keeper and supervisor while they watch many idle processes: their memory, and how often they are woken."""

from __future__ import annotations

import signal
import time
from typing import TYPE_CHECKING

from benchmarks import costs, launching
from benchmarks.figure import Figure, Sample
from benchmarks.signs import Signs

if TYPE_CHECKING:
    from collections.abc import Mapping

    from benchmarks.figure import Site

_SIZES = (20, 200)
FIGURES = (
    Figure(
        "watching-memory", "memory (PSS) of our processes watching 200", "none",
        "value", 24.0, "MiB", 200, _SIZES, 3, rounds=1,
    ),
    Figure(
        "wake-ups", "wake-ups of our processes in a minute, 200 idle", "none",
        "value", 6.0, "times", 200, _SIZES, 3, rounds=1,
    ),
)  # fmt: skip
_MINUTE = 60.0
# Where it is only tried out, and how long all must be at rest before, in seconds.
_SHORT = 2.0
_REST = 2.0


def measure(site: Site, size: int) -> Mapping[str, Sample]:
    """Measure it with so many processes."""
    with Signs(site.folder / "signs") as signs:
        script = f"echo up > {signs.path}; exec sleep 1000"
        file = site.folder / "idle.launch.yaml"
        file.write_text("launch:\n" + f"  - executable: {{cmd: /bin/sh -c '{script}'}}\n" * size)
        with launching.started(launching.orchestra("launch", file), site) as popen:
            signs.wait(size, popen)
            ours = [process.pid for process in costs.tree(popen.pid) if process.name.startswith("orc-")]
            _at_rest(ours)
            before = sum(map(costs.waits, ours))
            time.sleep(_MINUTE if size in _SIZES else _SHORT)
            woken = sum(map(costs.waits, ours)) - before
            memory = sum(map(costs.memory, ours))
            popen.send_signal(signal.SIGINT)
    return {"watching-memory": Sample(memory), "wake-ups": Sample(float(woken))}


def _at_rest(pids: list[int]) -> None:
    """Wait until the start is over: none of them has been woken for a while."""
    deadline = time.perf_counter() + launching.PATIENCE
    before, after = -1, sum(map(costs.waits, pids))
    while before != after:
        if time.perf_counter() > deadline:
            raise TimeoutError("our processes do not come to rest")
        time.sleep(_REST)
        before, after = after, sum(map(costs.waits, pids))
