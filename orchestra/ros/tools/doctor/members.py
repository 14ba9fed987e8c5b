"""The nodes of Orchestra's runs that are alive on this machine, with what they were given to meet others."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.ros.tools.doctor.observed import Member
from orchestra.supervise.environment import middleware
from orchestra.supervise.keeping import proc
from orchestra.supervise.keeping.marks import PROCESS, RUN
from orchestra.supervise.runs import registry
from orchestra.supervise.runs.directory import state_folder

if TYPE_CHECKING:
    from orchestra.supervise.runs.registry import Run

_NODES: Final = ("node", "lifecycle_node", "container")
# These say where something is kept or how it is shown, and nothing of who meets whom.
_ELSE: Final = (
    *("ROS_HOME", "ROS_LOG_DIR", "ROS_VERSION", "ROS_PYTHON_VERSION", "ROS_DISTRO", "ROS_PACKAGE_PATH"),
    *("ROS_ROOT", "ROS_ETC_DIR", "ROS_MASTER_URI", "ROS_IP", "ROS_HOSTNAME", "ROS_DISABLE_LOANED_MESSAGES"),
)


def members() -> tuple[Member, ...]:
    """Return them, by run."""
    environments = _environments()
    return tuple(
        Member(run.name, process, settings)
        for run in registry.living(state_folder() / "runs")
        for process in _nodes(run)
        if (settings := environments.get((run.identity.run, process))) is not None
    )


def _environments() -> dict[tuple[str, str], dict[str, str]]:
    """Return the settings of each process by the marks that it carries; of several with one mark, the oldest."""
    found: dict[tuple[str, str], dict[str, str]] = {}
    for pid in sorted(proc.pids()):
        try:
            raw = Path(f"/proc/{pid}/environ").read_bytes()
        except OSError:
            continue  # it has gone, or belongs to somebody else
        entries = (entry.decode(errors="replace").partition("=") for entry in raw.split(b"\0"))
        environment = {name: value for name, _, value in entries}
        if RUN in environment:
            settings = {k: v for k, v in middleware(environment).items() if k not in _ELSE}
            found.setdefault((environment[RUN], environment.get(PROCESS, "")), settings)
    return found


def _nodes(run: Run) -> list[str]:
    """Return the processes of a run that are nodes."""
    try:
        plan = json.loads((run.directory / "plan.json").read_text("utf-8", "surrogateescape"))
    except (OSError, ValueError):
        return []  # it is just being written, or has just gone
    return [process["id"] for process in plan["processes"] if process["kind"] in _NODES]
