"""Topics and services with several types, and types of which nodes have several definitions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.ros.tools.doctor.observed import Finding

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from orchestra.ros.tools.doctor.observed import Observed

_HASH: Final = "RIHS01_"


def check(seen: Observed) -> Iterator[Finding]:
    """Yield each topic and service with the nodes of each type."""
    types: dict[str, dict[str, list[str]]] = {}
    hashes: dict[str, dict[str, list[str]]] = {}
    for end in (*seen.system.publishers, *seen.system.subscriptions):
        types.setdefault(end.topic, {}).setdefault(end.type, []).append(end.node)
        if end.type_hash.startswith(_HASH) and end.type_hash.strip("0") != _HASH.strip("0"):
            hashes.setdefault(end.type, {}).setdefault(end.type_hash, []).append(end.node)
    for topic, nodes in types.items():
        if len(nodes) > 1:
            yield _finding(f"{topic} has {len(nodes)} types", topic, nodes)
    for name, found in seen.system.services:
        if len(found) > 1:
            yield Finding(
                "types",
                f"the service {name} has {len(found)} types: {', '.join(found)}",
                (name,),
                {"name": name, "types": {kind: [] for kind in found}},
            )
    for name, nodes in hashes.items():
        if len(nodes) > 1:
            yield _finding(f"{name} has {len(nodes)} definitions", name, nodes)


def _finding(what: str, name: str, nodes: Mapping[str, list[str]]) -> Finding:
    groups = {kind: sorted(set(found)) for kind, found in sorted(nodes.items())}
    told = "; ".join(f"{kind} ({', '.join(found)})" for kind, found in groups.items())
    return Finding("types", f"{what}: {told}", (name,), {"name": name, "types": groups})
