"""The names in the graph, in order, hidden ones left out unless they are asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.errors import RunError
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.ros.tools.graph.joining import Graph

Names = list[tuple[str, list[str]]]
_SHOWN = 8

# What the ROS 2 tools say of what is not there: scripts look for these words.
NO_NODE = "Node not found:"
NO_TOPIC = "Unknown topic"
NO_SERVICE = "Unknown service"
NO_ACTION = "Unknown action"
NO_CONTAINER = "Unable to find container node"


def hidden(name: str) -> bool:
    """Tell whether a token of a name begins with an underscore."""
    return "/_" in name or name.startswith("_")


def absolute(name: str) -> str:
    """Return a name with the slash in front that may be left out."""
    return name if name.startswith("/") else f"/{name}"


def listed(names: Iterable[Any], *, every: bool) -> Names:
    """Return names and types in order, without hidden ones unless `every` is asked for."""
    return sorted((name, sorted(types)) for name, types in names if every or not hidden(name))


def topics(graph: Graph, *, every: bool = True) -> Names:
    """Return the topics."""
    return listed(graph.node.get_topic_names_and_types(), every=every)


def services(graph: Graph, *, every: bool = True) -> Names:
    """Return the services."""
    return listed(graph.node.get_service_names_and_types(), every=every)


def nodes(graph: Graph, *, every: bool = False) -> list[str]:
    """Return the full names of the nodes, each as often as it is there, without our own."""
    found = graph.node.get_node_names_and_namespaces()
    ours = graph.node.get_name()
    return sorted(
        f"{space.rstrip('/')}/{name}"
        for name, space in found
        if name != ours and (every or not name.startswith("_"))
    )


def split(full: str) -> tuple[str, str]:
    """Return the name and the namespace of a node."""
    space, _, name = full.rpartition("/")
    return name, space or "/"


def unknown(told: str, name: str, known: Iterable[str]) -> RunError:
    """Return the error for what is not there, in the words of the ROS 2 tools, with what may be meant."""
    there = sorted(set(known))
    near = nearest(name, there)
    if near is not None:
        return RunError(f"{told} '{name}'; did you mean {near}?")
    if not there:
        return RunError(f"{told} '{name}', nor is there any other (ROS_DOMAIN_ID decides which are seen)")
    more = ", …" if len(there) > _SHOWN else ""
    return RunError(f"{told} '{name}'; there are {', '.join(there[:_SHOWN])}{more}")
