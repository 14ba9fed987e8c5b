"""The state of a run for people: what runs, what is waited for, and what is still to come."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.supervise.process.life import Phase

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.supervise.operation import Standing
    from orchestra.supervise.process.stopping import Stopping


def state_report(standings: Iterable[Standing], stopping: Stopping) -> str:
    """Return a line for each process, and when the run ends where it does."""
    standings = list(standings)
    width = max((len(standing.name) for standing in standings), default=0)
    lines = [f"  {standing.name.ljust(width)}  {_line(standing)}" for standing in standings]
    if stopping.remaining is not None:
        lines.append(f"  the run is ending: what is left in {max(0.0, stopping.remaining):.1f} s is killed")
    return "\n".join(lines)


def _line(standing: Standing) -> str:
    words = [standing.phase.ljust(10)]
    if standing.pid is not None:
        words.append(f"pid {standing.pid}")
    if standing.uptime is not None:
        words.append(f"for {standing.uptime:.1f} s")
    if standing.starts > 1:
        words.append(f"start {standing.starts}")
    if standing.awaited:
        words.append(f"waits for {standing.awaited}")
    if standing.ending and standing.phase in (Phase.EXITED, Phase.FAILED, Phase.RESTARTING):
        words.append(f"ended: {standing.ending}")
    return "  ".join(words)
