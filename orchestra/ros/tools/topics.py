"""`topic list`, `topic info`, `topic type`, `topic find`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.ros.tools.graph.closely import looking_closely
from orchestra.ros.tools.graph.names import NO_TOPIC, absolute, topics, unknown
from orchestra.ros.tools.graph.seeing import looking
from orchestra.ros.tools.telling import lines, tell

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.ros.tools.graph.seeing import Graph


def list_topics(options: Namespace) -> int:
    """Write the names of the topics."""
    with looking(options) as graph:
        own = _own_topics(graph)
        found = graph.whole(lambda: _counted(graph, own, every=options.include_hidden_topics))
    if options.count_topics:
        tell(options, f"{len(found)}\n", len(found))
        return 0
    data = [
        {"name": name, "types": types, "publishers": publishers, "subscriptions": subscriptions}
        for name, types, publishers, subscriptions in found
    ]
    if options.verbose:
        text = _group("Published", "publisher", [(name, types, count) for name, types, count, _ in found])
        text += _group("Subscribed", "subscriber", [(name, types, count) for name, types, _, count in found])
    elif options.show_types:
        text = lines(f"{name} [{', '.join(types)}]" for name, types, *_ in found)
    else:
        text = lines(name for name, *_ in found)
    tell(options, text, data)
    return 0


def info(options: Namespace) -> int:
    """Write type and endpoints of a topic."""
    topic = absolute(options.topic)
    with looking_closely(options) as graph:
        graph.whole(lambda: tuple(_identities(endpoints) for endpoints in _endpoints(graph, topic)))
        publishers, subscriptions = _endpoints(graph, topic)
        types = dict(topics(graph)).get(topic, [])
        if not (publishers or subscriptions):
            raise unknown(NO_TOPIC, topic, (name for name, _ in topics(graph, every=False)))
    gap = "\n\n" if options.verbose else "\n"
    parts = [f"Type: {types[0] if len(types) == 1 else types}", f"Publisher count: {len(publishers)}"]
    parts += map(str, publishers if options.verbose else ())
    parts.append(f"Subscription count: {len(subscriptions)}")
    parts += map(str, subscriptions if options.verbose else ())
    data = {
        "name": topic,
        "types": types,
        "publishers": [_endpoint(endpoint) for endpoint in publishers],
        "subscriptions": [_endpoint(endpoint) for endpoint in subscriptions],
    }
    tell(options, "".join(f"{part}{gap}" for part in parts), data)
    return 0


def topic_type(options: Namespace) -> int:
    """Write the type of a topic."""
    topic = absolute(options.topic)
    with looking(options) as graph:
        types = graph.found(lambda: dict(topics(graph)).get(topic))
        if not types:
            raise unknown(NO_TOPIC, topic, (name for name, _ in topics(graph, every=False)))
    tell(options, lines(types), types)
    return 0


def find(options: Namespace) -> int:
    """Write the topics of a type."""
    with looking(options) as graph:
        own = _own_topics(graph)
        seen = graph.whole(lambda: _counted(graph, own, every=options.include_hidden_topics))
    found = [name for name, types, *_ in seen if options.type in types]
    if options.count_topics:
        tell(options, f"{len(found)}\n", len(found))
    else:
        tell(options, lines(found), found)
    return 0


def _own_topics(graph: Graph) -> dict[str, tuple[int, int]]:
    """Return how many publishers and subscriptions our own node has on each topic."""
    node, name = graph.node, graph.node.get_name()
    seen = {topic for topic, _ in node.get_topic_names_and_types()}
    return {
        topic: (
            sum(endpoint.node_name == name for endpoint in node.get_publishers_info_by_topic(topic)),
            sum(endpoint.node_name == name for endpoint in node.get_subscriptions_info_by_topic(topic)),
        )
        for topic in seen
    }


def _counted(
    graph: Graph, own: dict[str, tuple[int, int]], *, every: bool
) -> list[tuple[str, list[str], int, int]]:
    """Return the topics with types and the numbers of publishers and subscriptions, without what only we have."""
    found = []
    for name, types in topics(graph, every=every):
        mine = own.get(name, (0, 0))
        publishers = graph.node.count_publishers(name) - mine[0]
        subscriptions = graph.node.count_subscribers(name) - mine[1]
        if publishers > 0 or subscriptions > 0:
            found.append((name, types, publishers, subscriptions))
    return found


def _group(title: str, word: str, counted: list[tuple[str, list[str], int]]) -> str:
    rows = "".join(
        f" * {name} [{', '.join(types)}] {count} {word}{'s' if count > 1 else ''}\n"
        for name, types, count in counted
        if count
    )
    return f"{title} topics:\n{rows}\n"


def _endpoints(graph: Graph, topic: str) -> tuple[list[Any], list[Any]]:
    """Return the publishers and the subscriptions of a topic, without ours."""
    ours = graph.node.get_name()
    publishers, subscriptions = (
        [endpoint for endpoint in ask(topic) if endpoint.node_name != ours]
        for ask in (graph.node.get_publishers_info_by_topic, graph.node.get_subscriptions_info_by_topic)
    )
    return publishers, subscriptions


def _identities(endpoints: list[Any]) -> list[tuple[bytes, str]]:
    return sorted((bytes(endpoint.endpoint_gid), endpoint.node_name) for endpoint in endpoints)


def _endpoint(endpoint: Any) -> dict[str, Any]:  # noqa: ANN401 - as above
    return {
        "node": f"{endpoint.node_namespace.rstrip('/')}/{endpoint.node_name}",
        "type": endpoint.topic_type,
        "type_hash": str(endpoint.topic_type_hash),
        "gid": ".".join(f"{byte:02x}" for byte in endpoint.endpoint_gid),
        "qos": _qos(endpoint),
    }


def _qos(endpoint: Any) -> dict[str, Any]:  # noqa: ANN401 - as above
    if hasattr(endpoint, "qos"):
        return dict(endpoint.qos)  # as it was on the wire
    from orchestra.ros.tools.graph.qos import data_of  # noqa: PLC0415 - most of rclpy, and only this needs it

    return data_of(endpoint.qos_profile)
