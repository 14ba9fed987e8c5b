"""`action list`, `action info`, `action type`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.ros.tools.graph.action_names import actions, clients, servers
from orchestra.ros.tools.graph.closely import looking_closely
from orchestra.ros.tools.graph.names import NO_ACTION, absolute, nodes, split, unknown
from orchestra.ros.tools.graph.seeing import looking
from orchestra.ros.tools.telling import lines, tell

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.ros.tools.graph.seeing import Graph


def list_actions(options: Namespace) -> int:
    """Write the names of the actions."""
    with looking(options) as graph:
        found = graph.whole(lambda: actions(graph))
    if options.count_actions:
        tell(options, f"{len(found)}\n", len(found))
        return 0
    shown = (f"{name} [{', '.join(types)}]" if options.show_types else name for name, types in found)
    tell(options, lines(shown), [{"name": name, "types": types} for name, types in found])
    return 0


def action_type(options: Namespace) -> int:
    """Write the type of an action."""
    name = absolute(options.action)
    with looking(options) as graph:
        types = graph.found(lambda: dict(actions(graph)).get(name))
        if not types:
            raise unknown(NO_ACTION, name, (known for known, _ in actions(graph)))
    tell(options, lines(types), types)
    return 0


def info(options: Namespace) -> int:
    """Write which nodes have clients and servers of an action."""
    name = absolute(options.action)
    with looking_closely(options) as graph:
        asking, serving = graph.whole(lambda: _ends(graph, name))
        if not (asking or serving):
            raise unknown(NO_ACTION, name, (known for known, _ in actions(graph)))
    text = f"Action: {name}\n"
    for title, ends in (("clients", asking), ("servers", serving)):
        text += f"Action {title}: {len(ends)}\n"
        if not options.count:
            text += lines(
                f"    {full} [{', '.join(types)}]" if options.show_types else f"    {full}"
                for full, types in ends
            )
    data = {
        "name": name,
        "clients": [{"node": full, "types": types} for full, types in asking],
        "servers": [{"node": full, "types": types} for full, types in serving],
    }
    tell(options, text, data)
    return 0


def _ends(graph: Graph, name: str) -> tuple[list[tuple[str, list[str]]], list[tuple[str, list[str]]]]:
    """Return the nodes that have clients and servers of an action, with types."""
    found: tuple[list[tuple[str, list[str]]], list[tuple[str, list[str]]]] = ([], [])
    for full in dict.fromkeys(nodes(graph, every=True)):
        for ends, look in zip(found, (clients, servers), strict=True):
            types = dict(look(graph, *split(full))).get(name)
            if types:
                ends.append((full, list(types)))
    return found
