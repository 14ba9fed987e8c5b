"""From what the plan says of a process to the rules of its life."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.supervise.process.life import Rules
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
    )
