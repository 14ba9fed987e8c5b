"""Plans whose processes are started warm, and beside each the same one cold."""

from __future__ import annotations

import os
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from orchestra.plan.warm import warmed
from tests.supervise.plans import PROCESSES, plan, process

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.model import Plan, Process

PUBLISHER = str(PROCESSES / "warm_node.py")


def warm(*processes: Process) -> Plan:
    """Return a plan of processes that are all started warm."""
    made = warmed(plan(*processes), os.environ)
    cold = [f"{one.id}: {one.warm.reason}" for one in made.processes if one.warm and not one.warm.warm]
    assert not cold
    return made


def both_ways(*processes: Process) -> Plan:
    """Return a plan with each process twice: warm, and cold with `_cold` behind its id."""
    made = warm(*processes).processes
    cold = (replace(one, id=f"{one.id}_cold", warm=None) for one in made)
    return plan(*made, *cold)


def node(identity: str, *command: str, **changes: Any) -> Process:
    """Return a node with a command."""
    return process(identity, kind="node", command=command, **changes)


def script(folder: Path, name: str, content: str, first: str = "#!/usr/bin/env python3") -> str:
    """Write an executable script and return its path."""
    path = folder / name
    path.write_text(f"{first}\n{content}", "utf-8")
    path.chmod(0o755)
    return str(path)
