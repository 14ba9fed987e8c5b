"""`node info`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.ros.tools.graph.action_names import clients, servers
from orchestra.ros.tools.graph.closely import looking_closely
from orchestra.ros.tools.graph.names import Names, absolute, listed, nodes, split, unknown
from orchestra.ros.tools.telling import tell, warn

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.ros.tools.graph.seeing import Graph

_GROUPS: Final = (
    ("subscribers", "Subscribers"),
    ("publishers", "Publishers"),
    ("service_servers", "Service Servers"),
    ("service_clients", "Service Clients"),
    ("action_servers", "Action Servers"),
    ("action_clients", "Action Clients"),
)


def info(options: Namespace) -> int:
    """Write what a node has: topics, services, actions, with types."""
    full = absolute(options.node)
    with looking_closely(options) as graph:
        seen = graph.whole(lambda: _endpoints(graph, full, every=options.include_hidden))
        if seen is None:
            raise unknown("Unable to find node", full, nodes(graph))
        count = nodes(graph, every=True).count(full)
    if count > 1:
        warn(
            f'There are {count} nodes in the graph with the exact name "{full}". '
            "You are seeing information about only one of them."
        )
    groups = "".join(f"  {title}:\n{_names(seen[key])}" for key, title in _GROUPS)
    data = {key: [{"name": name, "types": types} for name, types in seen[key]] for key, _ in _GROUPS}
    tell(options, f"{full}\n{groups}", {"node": full, **data})
    return 0


def _names(names: Names) -> str:
    """Return names with types; where there are none, the empty line that the ROS 2 tools write."""
    return "".join(f"    {name}: {', '.join(types)}\n" for name, types in names) or "\n"


def _endpoints(graph: Graph, full: str, *, every: bool) -> dict[str, Any] | None:
    """Return what is known of a node, None where the node is not."""
    if full not in nodes(graph, every=True):
        return None
    node, who = graph.node, split(full)
    return {
        "subscribers": listed(node.get_subscriber_names_and_types_by_node(*who), every=every),
        "publishers": listed(node.get_publisher_names_and_types_by_node(*who), every=every),
        "service_servers": listed(node.get_service_names_and_types_by_node(*who), every=every),
        "service_clients": listed(node.get_client_names_and_types_by_node(*who), every=every),
        "action_servers": listed(servers(graph, *who), every=every),
        "action_clients": listed(clients(graph, *who), every=every),
    }
