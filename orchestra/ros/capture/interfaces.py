"""The topics, services and actions of a node, as the graph shows them, with types and QoS."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from rclpy.action.graph import (
    get_action_client_names_and_types_by_node,
    get_action_server_names_and_types_by_node,
)
from rclpy.qos import DurabilityPolicy, HistoryPolicy, LivelinessPolicy, ReliabilityPolicy

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node

# What every node has.
_TOPICS: Final = ("/rosout", "/parameter_events", "/clock")
_SERVICES: Final = (
    "describe_parameters",
    "get_parameter_types",
    "get_parameters",
    "get_type_description",
    "list_parameters",
    "set_parameters",
    "set_parameters_atomically",
)
_ACTION: Final = "/_action/"
_NANOSECONDS: Final = 10**9
# What an endpoint of the graph has as an endless duration, and what the middlewares write for it.
_ENDLESS: Final = 2**62
_POLICIES: Final = {
    "reliability": ReliabilityPolicy,
    "durability": DurabilityPolicy,
    "history": HistoryPolicy,
    "liveliness": LivelinessPolicy,
}
_DURATIONS: Final = {
    "deadline": "deadline",
    "lifespan": "lifespan",
    "lease_duration": "liveliness_lease_duration",
}


def interfaces_of(full: str, node: Node) -> dict[str, list[dict[str, Any]]]:
    """Return the interfaces of a node, as JSON data, with full names."""
    space, _, name = full.rpartition("/")
    who = (name, space or "/")
    return {
        "publishers": _topics(
            node.get_publisher_names_and_types_by_node, node.get_publishers_info_by_topic, who
        ),
        "subscriptions": _topics(
            node.get_subscriber_names_and_types_by_node, node.get_subscriptions_info_by_topic, who
        ),
        "service_servers": _services(node.get_service_names_and_types_by_node(*who), full),
        "service_clients": _services(node.get_client_names_and_types_by_node(*who), full),
        "action_servers": _plain(get_action_server_names_and_types_by_node(node, *who)),
        "action_clients": _plain(get_action_client_names_and_types_by_node(node, *who)),
    }


def _topics(
    names: Callable[..., Any], endpoints: Callable[[str], Any], who: tuple[str, str]
) -> list[dict[str, Any]]:
    topics = [topic for topic, _ in sorted(names(*who)) if topic not in _TOPICS and _ACTION not in topic]
    return [
        {"name": topic, "type": endpoint.topic_type, "qos": _qos(endpoint.qos_profile)}
        for topic in topics
        for endpoint in endpoints(topic)
        if (endpoint.node_name, endpoint.node_namespace) == who
    ]


def _services(names: Any, full: str) -> list[dict[str, Any]]:  # noqa: ANN401 - of an untyped package
    own = {f"{full}/{name}" for name in _SERVICES}
    return [item for item in _plain(names) if item["name"] not in own and _ACTION not in item["name"]]


def _plain(names: Any) -> list[dict[str, Any]]:  # noqa: ANN401 - as above
    return [{"name": name, "type": kind} for name, kinds in sorted(names) for kind in kinds]


def _qos(profile: Any) -> dict[str, Any]:  # noqa: ANN401 - as above
    """Return the policies of an endpoint that are known, durations in seconds, without those that are endless."""
    found: dict[str, Any] = {}
    for key, policy in _POLICIES.items():
        word = policy(getattr(profile, key)).name.lower()
        if word != "unknown":
            found[key] = word
    if found.get("history") == "keep_last" and profile.depth:
        found["depth"] = profile.depth
    for key, attribute in _DURATIONS.items():
        nanoseconds = getattr(profile, attribute).nanoseconds
        if 0 < nanoseconds < _ENDLESS:
            found[key] = nanoseconds / _NANOSECONDS
    return found
