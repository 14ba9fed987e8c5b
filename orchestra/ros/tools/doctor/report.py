"""What `doctor --report` tells of the machine, the middleware and the graph."""

from __future__ import annotations

import os
import platform
import sys
from importlib.metadata import distributions
from typing import TYPE_CHECKING, Any, Final

from rclpy.utilities import get_rmw_implementation_identifier

from orchestra.ros.tools.graph.ports import domains_here
from orchestra.supervise.environment import middleware

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.ros.tools.doctor.observed import Observed
    from orchestra.ros.tools.graph.system import End

_PREFIXES: Final = ("ros-", "orchestra", "mcap", "mujoco", "numpy")


def report(seen: Observed, domain: int) -> dict[str, Any]:
    """Return it by section."""
    system = seen.system
    topics = sorted({end.topic for end in (*system.publishers, *system.subscriptions)})
    return {
        "machine": {
            "platform": platform.platform(),
            "processors": os.cpu_count(),
            "python": platform.python_version(),
            "interpreter": sys.executable,
        },
        "packages": _packages(),
        "middleware": {
            "implementation": get_rmw_implementation_identifier(),
            "domain": domain,
            "participants on this machine": {
                str(number): count for number, count in domains_here(domain).items()
            },
            "variables": middleware(os.environ),
        },
        "runs": _runs(seen),
        "nodes": {node: _node(seen, node) for node in sorted(set(system.nodes))},
        "topics": {
            topic: {
                "types": sorted(
                    {end.type for end in (*system.publishers, *system.subscriptions) if end.topic == topic}
                ),
                "publishers": _ends(topic, system.publishers),
                "subscriptions": _ends(topic, system.subscriptions),
            }
            for topic in topics
        },
        "services": {name: types for name, types in system.services if not _of_every_node(types)},
    }


def report_text(told: dict[str, Any]) -> str:
    """Return it as text: a heading for each section, one fact per line."""
    parts = []
    for section, facts in told.items():
        rows = "".join(f"  {name}: {_shown(fact)}\n" for name, fact in facts.items()) or "  none\n"
        parts.append(f"{section}\n{rows}")
    return "\n".join(parts)


def _shown(fact: Any) -> str:  # noqa: ANN401 - JSON data
    match fact:
        case dict():
            return "".join(f"\n    {name}: {_shown(value)}" for name, value in fact.items()) or "none"
        case list():
            return ", ".join(map(_shown, fact)) or "none"
    return str(fact)


def _packages() -> dict[str, str]:
    """Return the distributions that have to do with ROS, with their versions."""
    found = {found.name: found.version for found in distributions() if found.name.startswith(_PREFIXES)}
    return dict(sorted(found.items()))


def _runs(seen: Observed) -> dict[str, list[str]]:
    runs: dict[str, list[str]] = {}
    for member in seen.members:
        runs.setdefault(member.run, []).append(member.node)
    return runs


def _node(seen: Observed, node: str) -> str:
    if node in seen.silent:
        return "does not answer"
    return {True: "time of /clock", False: "real time", None: "time unknown"}[seen.sim_time.get(node)]


def _ends(topic: str, ends: Iterable[End]) -> list[str]:
    return [f"{end.node} ({end.qos.reliability}, {end.qos.durability})" for end in ends if end.topic == topic]


def _of_every_node(types: list[str]) -> bool:
    return all(kind.startswith(("rcl_interfaces/", "type_description_interfaces/")) for kind in types)
