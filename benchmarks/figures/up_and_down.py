"""Many processes that stay: until all are up, and from SIGINT to the launcher alone until all are gone."""

from __future__ import annotations

import os
import signal
import time
from typing import TYPE_CHECKING

from benchmarks import launching
from benchmarks.figure import Figure, Sample
from benchmarks.signs import Signs

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from benchmarks.figure import Site

_SIZES = (50, 100, 200)
FIGURES = (
    Figure("up", "200 processes up", "a loop of fork and exec", "ratio", 1.3, "s", 200, _SIZES, 5),
    Figure(
        "down", "200 processes down after SIGINT to the launcher", "killing them directly",
        "difference", 0.3, "s", 200, _SIZES, 5,
    ),
)  # fmt: skip


def measure(site: Site, size: int) -> Mapping[str, Sample]:
    """Measure it with so many processes; each says that it runs and then sleeps."""
    with Signs(site.folder / "signs") as signs:
        script = f"echo up > {signs.path}; exec sleep 1000"
        file = site.folder / "many.launch.yaml"
        file.write_text("launch:\n" + f"  - executable: {{cmd: /bin/sh -c '{script}'}}\n" * size)
        floor_up, floor_down = _directly(signs, ("/bin/sh", "-c", script), size)
        all_up, down, _ = _launched(signs, launching.orchestra("launch", file), site, size)
        began = min(launching.moments(site, "process_starting"))
        other = launching.upstream(file)
        peer_up, peer_down = None, None
        if other:
            peer_at, peer_down, peer_began = _launched(signs, other, site, size)
            peer_up = peer_at - peer_began
    return {"up": Sample(all_up - began, floor_up, peer_up), "down": Sample(down, floor_down, peer_down)}


def _directly(signs: Signs, words: tuple[str, ...], size: int) -> tuple[float, float]:
    """Return how long it takes to start them by fork and exec, and to end them by a signal to each."""
    began = time.perf_counter()
    pids = []
    for _ in range(size):
        pid = os.fork()
        if not pid:
            os.setsid()
            os.execv(words[0], words)  # noqa: S606 - no shell is wanted
        pids.append(pid)
    up = signs.wait(len(signs.lines) + size) - began
    began = time.perf_counter()
    for pid in pids:
        os.kill(pid, signal.SIGINT)
    for pid in pids:
        os.waitpid(pid, 0)
    return up, time.perf_counter() - began


def _launched(signs: Signs, command: Sequence[str], site: Site, size: int) -> tuple[float, float, float]:
    """Return when all were up, how long it took until the launcher had ended, and when it was started."""
    before = len(signs.lines)
    began = time.perf_counter()
    with launching.started(command, site) as popen:
        up = signs.wait(before + size, popen)
        interrupted = time.perf_counter()
        popen.send_signal(signal.SIGINT)
        launching.finished(popen)
        return up, time.perf_counter() - interrupted, began
