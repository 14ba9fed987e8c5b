"""Whether the nodes of one run can meet: domain, middleware and discovery."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.ros.tools.doctor.observed import Finding

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.ros.tools.doctor.observed import Member, Observed

# What counts where nothing is set.
_DEFAULTS: Final = {"ROS_DOMAIN_ID": "0", "RMW_IMPLEMENTATION": "rmw_fastrtps_cpp", "ROS_LOCALHOST_ONLY": "0"}
_SHOWN: Final = 4


def check(seen: Observed) -> Iterator[Finding]:
    """Yield each variable that differs between nodes of a run."""
    runs: dict[str, list[Member]] = {}
    for member in seen.members:
        runs.setdefault(member.run, []).append(member)
    for run, members in runs.items():
        for name in sorted({name for member in members for name in member.settings}):
            groups: dict[str, list[str]] = {}
            for member in members:
                value = member.settings.get(name) or _DEFAULTS.get(name, "")
                groups.setdefault(value, []).append(member.node)
            if len(groups) > 1:
                yield _finding(run, name, groups)


def _finding(run: str, name: str, groups: dict[str, list[str]]) -> Finding:
    told = ", ".join(f"{value or 'not set'} for {_listed(nodes)}" for value, nodes in groups.items())
    nodes = min(groups.values(), key=len)
    details = {"run": run, "variable": name, "values": groups}
    return Finding("settings", f"in the run {run}, {name} is {told}", tuple(nodes), details)


def _listed(nodes: list[str]) -> str:
    more = f" and {len(nodes) - _SHOWN} more" if len(nodes) > _SHOWN else ""
    return ", ".join(sorted(nodes)[:_SHOWN]) + more
