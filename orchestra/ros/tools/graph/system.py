"""All of the graph at one time, as plain data: nodes, and the ends of topics with their types and QoS."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.dataclass import dataclass
from orchestra.declared.interfaces.compatibility import misfits
from orchestra.declared.interfaces.model import Qos
from orchestra.ros.tools.graph.names import Names, hidden, nodes, services, topics
from orchestra.ros.tools.graph.qos import data_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from orchestra.declared.interfaces.compatibility import Misfit
    from orchestra.ros.tools.graph.joining import Graph

# What every node has.
COMMON: Final = frozenset({"/rosout", "/parameter_events"})
_ENDLESS: Final = float("inf")


@dataclass(frozen=True, slots=True)
class End:
    """A publisher or a subscription; `key` tells it from all others, `profile` is its QoS as plain data."""

    topic: str
    node: str
    type: str
    type_hash: str
    key: str
    profile: dict[str, Any]

    @property
    def qos(self) -> Qos:
        """The part of its QoS that decides who talks with whom."""
        spans = {
            "deadline": self.profile["deadline"],
            "lease_duration": self.profile["liveliness_lease_duration"],
        }
        return Qos(
            self.profile["reliability"],
            self.profile["durability"],
            self.profile["liveliness"],
            **{name: span or _ENDLESS for name, span in spans.items()},  # 0 stands for what is not given
        )


@dataclass(frozen=True, slots=True)
class System:
    """The graph without the nodes of commands: `nodes` has each name as often as it is there."""

    nodes: tuple[str, ...]
    publishers: tuple[End, ...]
    subscriptions: tuple[End, ...]
    services: Names

    def without_hidden(self) -> System:
        """Return it without hidden nodes, topics and services."""
        shown = [(name, types) for name, types in self.services if not hidden(name)]
        bare = System(self.nodes, self.publishers, self.subscriptions, shown)
        return bare.only(
            lambda node: not hidden(node), lambda end: not (hidden(end.node) or hidden(end.topic))
        )

    def only(self, node: Callable[[str], bool], end: Callable[[End], bool]) -> System:
        """Return the nodes and the ends for which these hold."""
        publishers, subscriptions = filter(end, self.publishers), filter(end, self.subscriptions)
        return System(tuple(filter(node, self.nodes)), tuple(publishers), tuple(subscriptions), self.services)

    def pairs(self) -> Iterator[tuple[End, End]]:
        """Yield each publisher with each subscription of its topic and type."""
        for subscription in self.subscriptions:
            for publisher in self.publishers:
                if (publisher.topic, publisher.type) == (subscription.topic, subscription.type):
                    yield publisher, subscription


def mismatch(publisher: End, subscription: End) -> list[Misfit]:
    """Return the policies of which the publisher offers less than the subscription asks for."""
    return list(misfits(publisher.qos, subscription.qos))


def system(graph: Graph) -> System:
    """Return what is seen of the graph now, in order."""
    ours = graph.node.get_name()
    found: tuple[list[End], list[End]] = ([], [])
    looks = (graph.node.get_publishers_info_by_topic, graph.node.get_subscriptions_info_by_topic)
    for topic, _ in topics(graph):
        for ends, look in zip(found, looks, strict=True):
            ends += [_end(topic, one) for one in look(topic) if one.node_name != ours]
    own = f"/{ours}/"
    publishers, subscriptions = (
        tuple(sorted(ends, key=lambda end: (end.topic, end.node, end.key))) for ends in found
    )
    offered = [(name, types) for name, types in services(graph) if not name.startswith(own)]
    return System(tuple(nodes(graph, every=True)), publishers, subscriptions, offered)


def _end(topic: str, endpoint: Any) -> End:  # noqa: ANN401 - of an untyped package
    return End(
        topic,
        f"{endpoint.node_namespace.rstrip('/')}/{endpoint.node_name}",
        endpoint.topic_type,
        str(endpoint.topic_type_hash),
        ".".join(f"{byte:02x}" for byte in endpoint.endpoint_gid),
        data_of(endpoint.qos_profile),
    )
