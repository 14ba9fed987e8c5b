"""The actions in the graph, by the topic on which each server tells how far it is (rcl_action's `graph.c`)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.ros.tools.graph.names import Names, listed

if TYPE_CHECKING:
    from orchestra.ros.tools.graph.seeing import Graph

_FEEDBACK: Final = "/_action/feedback"
_MESSAGE: Final = "_FeedbackMessage"


def actions(graph: Graph) -> Names:
    """Return the actions with their types."""
    return actions_of(graph.node.get_topic_names_and_types())


def servers(graph: Graph, name: str, space: str) -> Names:
    """Return the actions of which a node is the server."""
    return actions_of(graph.node.get_publisher_names_and_types_by_node(name, space))


def clients(graph: Graph, name: str, space: str) -> Names:
    """Return the actions of which a node is a client."""
    return actions_of(graph.node.get_subscriber_names_and_types_by_node(name, space))


def actions_of(topics: Names) -> Names:
    """Return the actions that topics with types belong to."""
    return listed(
        (
            (topic.removesuffix(_FEEDBACK), [kind.removesuffix(_MESSAGE) for kind in types])
            for topic, types in topics
            if topic.endswith(_FEEDBACK) and all(kind.endswith(_MESSAGE) for kind in types)
        ),
        every=True,
    )
