"""Twenty Python nodes until the last has published: seconds, seconds on a processor, memory."""

from __future__ import annotations

import shlex
import signal
import time
from typing import TYPE_CHECKING, NamedTuple

from benchmarks import costs, launching, node_package
from benchmarks.figure import Figure, Sample, Site
from benchmarks.signs import Signs

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

_FLOOR = "a shell loop with `&`"
_SIZES = (5, 10, 20)
FIGURES = (
    Figure("nodes", "20 Python nodes, until the last has published", _FLOOR, "ratio", 0.4, "s", 20, _SIZES, 1),
    Figure("nodes-cpu", "the same, seconds on a processor", _FLOOR, "ratio", 0.35, "s", 20, _SIZES, 1),
    Figure(
        "nodes-memory", "memory (PSS) of these nodes and the fork server", _FLOOR,
        "ratio", 0.65, "MiB", 20, _SIZES, 1,
    ),
)  # fmt: skip
_OURS = ("orc-keeper", "orc-supervisor", "orc-guard", "orc-resolver", "orc-writer")


class Cost(NamedTuple):
    """What the nodes cost until the last has published, in seconds, seconds on a processor, and MiB."""

    wall: float
    cpu: float
    memory: float


def measure(site: Site, size: int) -> Mapping[str, Sample]:
    """Measure it with so many nodes."""
    file = node_package.write(site.folder, size)
    loop = "; ".join(f"setsid {shlex.join(node_package.by_hand(number))} &" for number in range(size))
    loop = loop.replace("&;", "&\n")
    with Signs(site.folder / "signs") as signs:
        signalling = Site(site.folder, launching.with_variables(site.environment, BENCHMARK_SIGNS=signs.path))
        floor = _cost(signs, ["/bin/sh", "-c", f"{loop}\nwait"], signalling, size)
        ours = _cost(signs, launching.orchestra("launch", file), signalling, size)
        other = launching.upstream(file)
        peer = _cost(signs, other, signalling, size) if other else None
    return {
        figure.name: Sample(ours[index], floor[index], peer[index] if peer else None)
        for index, figure in enumerate(FIGURES)
    }


def _cost(signs: Signs, command: Sequence[str], site: Site, size: int) -> Cost:
    before = len(signs.lines)
    began = time.perf_counter()
    with launching.started(command, site) as popen:
        seconds = signs.wait(before + size, popen) - began
        processes = costs.tree(popen.pid)
        cpu = sum(process.seconds for process in processes)
        nodes = [process.pid for process in processes[1:] if process.name not in _OURS]
        memory = sum(map(costs.memory, nodes))
        if command[0] == "/bin/sh":
            # A shell ignores SIGINT for what it starts with `&`.
            launching.end([int(pid) for pid in signs.lines[before:]])
        else:
            popen.send_signal(signal.SIGINT)
    return Cost(seconds, cpu, memory)
