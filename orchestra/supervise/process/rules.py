"""From what the plan says of a process to the rules of its life."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.fields import replace
from orchestra.supervise.process.life import QUIESCE_WITHIN, Rules
from orchestra.values import Stop

if TYPE_CHECKING:
    from orchestra.plan.model import Process


def rules_of(process: Process) -> Rules:
    """Return what the plan says about the life of a process."""
    return Rules(
        restart=process.restart,
        stop=process.stop or Stop(),
        success=frozenset({0} if process.success_exit_codes is None else process.success_exit_codes),
        awaits_ready=process.ready is not None,
        ready_timeout=process.ready.timeout if process.ready else None,
        guarded=process.alive is not None,
        aborts=process.alive is not None and process.alive.abort,
        managed=process.lifecycle == "active" or process.kind in ("node", "container"),
        quiesce_within=_quiesce_within(process),
    )


def stop_of(process: Process) -> Stop | None:
    """Return how the description has a process ended, the time to deactivate included; None where it says nothing."""
    longer = _longer(process)
    return process.stop if longer is None else replace(longer, timeout=2 * longer.timeout)


def _quiesce_within(process: Process) -> float:
    longer = _longer(process)
    return QUIESCE_WITHIN if longer is None else longer.timeout


def _longer(process: Process) -> Stop | None:
    """Return the stop of a process that deactivates nodes and is given more time than usual: it is meant for both."""
    deactivates = process.lifecycle == "active" or process.kind == "container"
    stop = process.stop
    return stop if deactivates and stop is not None and stop.timeout > Stop().timeout else None
