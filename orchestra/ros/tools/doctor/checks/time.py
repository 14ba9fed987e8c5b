"""Whether all nodes take their time from one clock."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.ros.tools.doctor.observed import Finding

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.ros.tools.doctor.observed import Observed

CLOCK: Final = "/clock"
_SHOWN: Final = 8


def check(seen: Observed) -> Iterator[Finding]:
    """Yield that nodes differ, or that they wait for a clock that nobody publishes.

    Whoever publishes /clock has the time of his own.
    """
    givers = {end.node for end in seen.system.publishers if end.topic == CLOCK}
    simulated = sorted(node for node, taken in seen.sim_time.items() if taken)
    real = sorted(node for node, taken in seen.sim_time.items() if not taken and node not in givers)
    if simulated and not givers:
        yield Finding(
            "time",
            f"{_listed(simulated)} {_have(simulated)} use_sim_time, and nobody publishes {CLOCK}",
            tuple(simulated),
            {"use_sim_time": simulated, "real_time": real},
        )
    elif simulated and real:
        yield Finding(
            "time",
            f"{_listed(simulated)} {_have(simulated)} use_sim_time, {_listed(real)} {_have(real)} not",
            tuple(simulated if len(simulated) < len(real) else real),
            {"use_sim_time": simulated, "real_time": real},
        )


def _listed(nodes: Sequence[str]) -> str:
    more = f" and {len(nodes) - _SHOWN} more" if len(nodes) > _SHOWN else ""
    return ", ".join(nodes[:_SHOWN]) + more


def _have(nodes: Sequence[str]) -> str:
    return "has" if len(nodes) == 1 else "have"
